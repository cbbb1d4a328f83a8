#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <particle_surface_tracker/InterpolatedField.h>
#include <sensor_msgs/PointCloud2.h>

#include "bag_parts.h"
#include "particle_surface_tracker/io/cell_files.h"
#include "particle_surface_tracker/io/mesh_sequence.h"
#include "particle_surface_tracker/io/report_writer.h"
#include "particle_surface_tracker/io/vdb_sequence.h"
#include "particle_surface_tracker/ros/frame_handler.h"
#include "particle_surface_tracker/ros/offline_runner.h"
#include "particle_surface_tracker/ros/tracking_bag_writer.h"
#include "run_checkpoint.h"

namespace particle_surface_tracker {

/// The files that a run writes. Whatever cannot be written is found out before any work is done.
class RunOutputs {
 public:
  /// \param from where the files of an interrupted run go on; null: they begin.
  /// \throw ParameterError if the options do not fit each other, or that run.
  /// \throw InputError, OutputError as MeshSequence, ReportWriter, TrackingBagWriter and BagParts.
  RunOutputs(const OfflineOptions& options, const RunProgress* from);

  /// Whether the cells of a frame are to be recorded for write().
  bool wants_cells(std::uint64_t frame) const;

  /// \param interpolated fields that mesh files and bag have beside those of the mesh.
  /// \throw OutputError if something cannot be written.
  void write(std::uint64_t frame, const sensor_msgs::PointCloud2ConstPtr& cloud, const FrameHandler& handler,
             const FrameReport& report, std::vector<InterpolatedField> interpolated);
  void write_error(std::uint64_t frame, const std::string& error);

  /// Completes all files as far as they have got, so that a run can go on from here.
  /// \throw OutputError if one cannot be completed.
  OutputProgress settle();

  /// Completes all files for good.
  /// \throw OutputError if one cannot be completed.
  OutputProgress finish();

  /// Folders of meshes in which files of another run are left, and how many.
  std::vector<std::pair<std::string, std::size_t>> leftovers() const;

  /// Removes what only an earlier checkpoint refers to.
  void clean_up();

 private:
  void open_meshes(const OfflineOptions& options, const RunProgress* from);
  void open_report(const OfflineOptions& options, const OutputProgress* from);
  void open_bag(const OfflineOptions& options, const OutputProgress* from);

  std::optional<MeshSequence> meshes_;
  std::optional<MeshSequence> surfaces_;
  std::optional<VdbSequence> fields_;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> cell_frames_;
  std::optional<CellFiles> cells_;
  std::optional<ReportWriter> report_;
  std::optional<TrackingBagWriter> bag_;  // Either this one,
  std::optional<BagParts> parts_;         // or this one.
};

}  // namespace particle_surface_tracker
