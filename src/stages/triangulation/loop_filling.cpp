#include "loop_filling.h"

namespace particle_surface_tracker {

namespace {

/// Triangulates the part first .. last of a loop; its ends are joined by a segment or an allowed diagonal.
bool fill_part(const CellLoops& loops, int first, int last, LoopFilling& filling) {
  if (last - first < 2) return true;
  const auto joined = [&](int a, int b) { return b - a == 1 || !edges_share_face(loops.edge[a], loops.edge[b]); };
  for (int middle = first + 1; middle < last; ++middle) {
    if (!joined(first, middle) || !joined(middle, last)) continue;
    const int count = filling.triangle_count;
    filling.triangles[filling.triangle_count++] = {loops.edge[first], loops.edge[middle], loops.edge[last]};
    if (fill_part(loops, first, middle, filling) && fill_part(loops, middle, last, filling)) return true;
    filling.triangle_count = count;
  }
  return false;
}

std::array<LoopFilling, 256> make_loop_fillings() {
  std::array<LoopFilling, 256> table;
  for (int inside = 0; inside < 256; ++inside) {
    const CellLoops& loops = cell_loops()[inside];
    for (int loop = 0; loop < loops.count; ++loop) {
      fill_part(loops, loops.begin[loop], loops.begin[loop + 1] - 1, table[inside]);
    }
  }
  return table;
}

}  // namespace

const std::array<LoopFilling, 256>& loop_fillings() {
  static const std::array<LoopFilling, 256> table = make_loop_fillings();
  return table;
}

}  // namespace particle_surface_tracker
