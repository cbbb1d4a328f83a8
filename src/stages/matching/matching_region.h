#pragma once

#include <vector>

#include <openvdb/Types.h>

#include "line_signs.h"
#include "stages/nodes/node_masks.h"

namespace particle_surface_tracker {

/// The nodes at some cells: the eight corners of each.
NodeMasks nodes_at_cells(const std::vector<openvdb::Coord>& cells);

/// Adds the nodes of one set to another.
void unite(NodeMasks& set, const NodeMasks& other);

/// Takes the nodes of one set out of another.
void remove_nodes(NodeMasks& set, const NodeMasks& removed);

/// True if a set has no node.
bool is_empty(const NodeMasks& set);

/// The nodes of a set that have a node of the other side among their 26 neighbours, in it or not.
NodeMasks nodes_next_to_other_side(const NodeMasks& set, const LineSigns& signs);

/// The nodes of a region that topology matching looks at.
struct MatchingNodes {
  NodeMasks unknown;  ///< To be solved for.
  NodeMasks fixed;    ///< Keep Γ.
};

/// Fixed are those that are not flagged, around which the mesh winds 0 or 1 times, and that have a node of the other
/// side among their 26 neighbours (Sec. 6; a mesh is then within h√3); the others are unknown.
MatchingNodes classify_nodes(const NodeMasks& region, const NodeMasks& flagged, const LineSigns& mesh);

/// True if a node belongs to the outermost layer of a region or is next to it.
bool is_near_rim(const NodeMasks& region, const openvdb::Coord& node);

/// Sorts nodes and drops those that are there twice.
void settle(std::vector<openvdb::Coord>& nodes);

/// The nodes of one or of many lists as a set.
NodeMasks masks_of(const std::vector<openvdb::Coord>& nodes);
NodeMasks masks_of(const std::vector<std::vector<openvdb::Coord>>& lists);

}  // namespace particle_surface_tracker
