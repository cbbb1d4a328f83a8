#pragma once

#include <memory>
#include <string>

#include <particle_surface_tracker/TrackedMesh.h>
#include <sensor_msgs/PointCloud2.h>

namespace particle_surface_tracker {

/// Writes a bag of particles, and of the mesh tracked with them. Record time is the stamp of the message, so that a
/// player can be paced by it.
///
/// The bag is written under a temporary name beside its own and takes its name when it is closed, complete and indexed.
class TrackingBagWriter {
 public:
  static constexpr const char* mesh_topic = "/tracked_mesh";

  /// \param particle_topic topic of the particles.
  /// \throw OutputError if the bag cannot be written.
  TrackingBagWriter(std::string path, std::string particle_topic);

  /// Closes the bag as close() does, but cannot tell whether that fails. A bag without a frame is removed.
  ~TrackingBagWriter();

  /// Writes particles without a mesh.
  /// \throw OutputError if the message cannot be written.
  void write(const sensor_msgs::PointCloud2ConstPtr& particles);

  /// \throw OutputError if the messages cannot be written.
  void write(const sensor_msgs::PointCloud2ConstPtr& particles, const TrackedMesh& mesh);

  /// \throw OutputError if the bag cannot be completed or renamed.
  void close();

 private:
  struct Bag;

  template <class Message>
  void append(const std::string& topic, const std_msgs::Header& header, const Message& message);

  // Lets go of a bag that could not be written: its destructor would try again and throw, which ends the program.
  void abandon();

  std::string path_;
  std::string temporary_path_;
  std::string particle_topic_;
  std::unique_ptr<Bag> bag_;
};

}  // namespace particle_surface_tracker
