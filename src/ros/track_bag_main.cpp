#include <unistd.h>

#include <atomic>
#include <csignal>
#include <iostream>

#include "particle_surface_tracker/core/error.h"
#include "run_messages.h"
#include "track_bag_options.h"

namespace {

using namespace particle_surface_tracker;

enum ExitCode { kOk = 0, kUsage = 1, kInput = 2, kTracking = 3, kOutput = 4, kInterrupted = 130 };

std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may not wait");

void request_stop(int signal) {
  stop_requested = true;
  std::signal(signal, SIG_DFL);  // A second one ends the program at once.
}

void handle_signals() {
  std::signal(SIGINT, request_stop);
  std::signal(SIGTERM, request_stop);
  // Full disks and closed pipes are reported by the call that meets them.
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
}

ExitCode run(int argc, char** argv) {
  CommandLine command = read_command_line(argc, argv);
  if (!command.options) {
    std::cout << command.text;
    return kOk;
  }
  command.options->progress = isatty(STDERR_FILENO) != 0;
  const OfflineSummary summary = run_offline(*command.options, stop_requested, std::cout, std::cerr);
  return summary.interrupted ? kInterrupted : kOk;
}

ExitCode fail(ExitCode code, const std::exception& error) {
  std::cerr << "track_bag: " << one_line(error.what()) << std::endl;
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  handle_signals();
  try {
    return run(argc, argv);
  } catch (const ParameterError& error) {
    return fail(kUsage, error);
  } catch (const OutputError& error) {
    return fail(kOutput, error);
  } catch (const InputError& error) {
    return fail(kInput, error);
  } catch (const ParticleError& error) {
    return fail(kInput, error);
  } catch (const MeshError& error) {
    return fail(kInput, error);
  } catch (const std::exception& error) {
    return fail(kTracking, error);
  }
}
