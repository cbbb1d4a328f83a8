#include "ros/live/topology_markers.h"

#include <algorithm>

#include <boost/make_shared.hpp>

namespace particle_surface_tracker {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArrayPtr;

/// More is not remembered: markers may be rare, and the liquid wild.
constexpr std::size_t kMostCells = 100000;
constexpr std::size_t kMostLabels = 200;
constexpr double kLabelLifetime = 3.0;  // [s]

Marker begin_marker(const std_msgs::Header& header, const char* name, float red, float green, float blue) {
  Marker marker;
  marker.header = header;
  marker.ns = name;
  marker.pose.orientation.w = 1.0;
  marker.color.r = red;
  marker.color.g = green;
  marker.color.b = blue;
  marker.color.a = 1.0f;
  return marker;
}

Marker cell_marker(const TrackedView& view, const std::vector<openvdb::Coord>& cells, const char* name, float red,
                   float green, float blue) {
  Marker marker = begin_marker(view.mesh->header, name, red, green, blue);
  marker.color.a = 0.5f;
  marker.type = Marker::CUBE_LIST;
  // rviz complains of a list without points.
  marker.action = cells.empty() ? Marker::DELETE : Marker::ADD;
  marker.scale.x = marker.scale.y = marker.scale.z = view.cell_size;
  marker.points.reserve(cells.size());
  for (const openvdb::Coord& cell : cells) {
    geometry_msgs::Point middle;
    middle.x = (cell.x() + 0.5) * view.cell_size;
    middle.y = (cell.y() + 0.5) * view.cell_size;
    middle.z = (cell.z() + 0.5) * view.cell_size;
    marker.points.push_back(middle);
  }
  return marker;
}

const char* text_of(TopologyEvent::Kind kind) {
  switch (kind) {
    case TopologyEvent::Kind::kSplit:
      return "split";
    case TopologyEvent::Kind::kMerge:
      return "merge";
    case TopologyEvent::Kind::kGone:
      break;
  }
  return "gone";
}

Marker label(const TrackedView& view, const TopologyEvent& event, int id) {
  Marker marker = begin_marker(view.mesh->header, "events", 0.1f, 0.1f, 0.1f);
  marker.id = id;
  marker.type = Marker::TEXT_VIEW_FACING;
  marker.text = text_of(event.kind);
  marker.scale.z = 2.0 * view.r;
  marker.pose.position.x = event.place.x();
  marker.pose.position.y = event.place.y();
  marker.pose.position.z = event.place.z();
  marker.lifetime = ros::Duration(kLabelLifetime);
  return marker;
}

}  // namespace

void TopologyMarkers::remember(const TrackedView& view) {
  const std::size_t cells = std::min(view.remeshed_cells.size(), kMostCells - remeshed_cells_.size());
  remeshed_cells_.insert(remeshed_cells_.end(), view.remeshed_cells.begin(),
                         view.remeshed_cells.begin() + static_cast<std::ptrdiff_t>(cells));
  const std::size_t events = std::min(view.events.size(), kMostLabels - events_.size());
  events_.insert(events_.end(), view.events.begin(), view.events.begin() + static_cast<std::ptrdiff_t>(events));
}

MarkerArrayPtr TopologyMarkers::show(const TrackedView& view) {
  auto markers = boost::make_shared<visualization_msgs::MarkerArray>();
  std::sort(remeshed_cells_.begin(), remeshed_cells_.end());
  remeshed_cells_.erase(std::unique(remeshed_cells_.begin(), remeshed_cells_.end()), remeshed_cells_.end());
  markers->markers.push_back(cell_marker(view, view.flagged_cells, "flagged_cells", 0.9f, 0.2f, 0.1f));
  markers->markers.push_back(cell_marker(view, remeshed_cells_, "remeshed_cells", 0.2f, 0.7f, 0.3f));
  if (view.cells != nullptr) {
    const TopologyCells& cells = *view.cells;
    markers->markers.push_back(cell_marker(view, cells.complex, "complex_cells", 0.2f, 0.4f, 1.0f));
    markers->markers.push_back(cell_marker(view, cells.tangled, "tangled_cells", 1.0f, 0.6f, 0.0f));
    markers->markers.push_back(cell_marker(view, cells.deep, "deep_cells", 0.6f, 0.0f, 0.8f));
    markers->markers.push_back(cell_marker(view, cells.front, "front_cells", 0.1f, 0.1f, 0.1f));
  }
  for (const TopologyEvent& event : events_) {
    markers->markers.push_back(label(view, event, next_label_));
    next_label_ = (next_label_ + 1) % static_cast<int>(kMostLabels);
  }
  remeshed_cells_.clear();
  events_.clear();
  return markers;
}

MarkerArrayPtr TopologyMarkers::remove(const std_msgs::Header& header) {
  remeshed_cells_.clear();
  events_.clear();
  auto markers = boost::make_shared<visualization_msgs::MarkerArray>();
  Marker all;
  all.header = header;
  all.action = Marker::DELETEALL;
  markers->markers.push_back(all);
  return markers;
}

}  // namespace particle_surface_tracker
