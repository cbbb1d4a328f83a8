#include "surface_cells.h"

namespace particle_surface_tracker {

SurfaceCells::SurfaceCells(const ImplicitSurface& surface)
    : surface_(surface), per_meter_(1.0 / surface.dx), normals_(surface.triangulation), index_(64) {
  constexpr int leaf_mask = 7;
  const std::vector<CutCell>& cells = surface.triangulation.cells;
  for (std::uint32_t c = 0; c + 1 < cells.size(); ++c) {
    const openvdb::Coord origin = cells[c].origin & ~leaf_mask;
    if (leaves_.empty() || leaves_.back().origin != origin) {
      index_.insert(origin, static_cast<std::uint32_t>(leaves_.size()));
      leaves_.push_back({origin, c, c});
    }
    leaves_.back().end = c + 1;
  }
}

}  // namespace particle_surface_tracker
