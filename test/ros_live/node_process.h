#pragma once

#include <csignal>
#include <string>

#include <sys/types.h>

namespace particle_surface_tracker::test {

/// The process of a node that runs.
/// \return 0 if it does not answer.
pid_t process_of(const std::string& node);

/// Sends a signal to the process of a node. About SIGKILL it cannot do anything; with SIGINT it ends in order.
/// \return the process; 0 if there is none.
pid_t kill_node(const std::string& node, int signal = SIGKILL);

/// Connections through which a node receives a topic.
int connection_count(const std::string& node, const std::string& topic);

/// Waits until a node runs in another process than a given one.
/// \return whether it does.
bool wait_for_respawn(const std::string& node, pid_t killed);

}  // namespace particle_surface_tracker::test
