#include <fmt/format.h>

#include "file_check.h"

namespace particle_surface_tracker {
namespace {

constexpr std::size_t kListedComponents = 20;

std::string describe_kind(const MeshComponent& component) {
  if (!component.is_closed) return "not closed";
  const std::string kind = component.volume > 0.0 ? "solid" : component.volume < 0.0 ? "cavity" : "without volume";
  const std::string genus = component.is_manifold ? fmt::format("genus {}", component.genus) : "not manifold";
  return fmt::format("{}, {}, volume {:.6g} m³, winding number around it {}", kind, genus, component.volume,
                     component.winding_around);
}

std::string sizes_of(const MeshCheck& mesh) {
  return fmt::format("  {} vertices, {} triangles, {} components, genus {}, volume {:.6g} m³, area {:.6g} m²\n",
                     mesh.vertices, mesh.triangles, mesh.components.size(), mesh.genus(), mesh.volume(), mesh.area());
}

std::string components_of(const MeshCheck& mesh) {
  if (mesh.components.size() < 2) return "";
  std::string text;
  for (std::size_t c = 0; c < mesh.components.size() && c < kListedComponents; ++c) {
    const MeshComponent& component = mesh.components[c];
    text += fmt::format("  component {}: {} triangles, first vertex {}, {}\n", c, component.triangles,
                        component.first_vertex, describe_kind(component));
  }
  if (mesh.components.size() > kListedComponents) {
    text += fmt::format("  … and {} more (--json lists all)\n", mesh.components.size() - kListedComponents);
  }
  return text;
}

std::string defects_of(const MeshCheck& mesh, double max_self_intersecting_share) {
  std::string text;
  for (const NamedMeshDefect& kind : list_defects(mesh)) {
    if (kind.defect->count == 0) continue;
    text += fmt::format("  {} {}", kind.defect->count, kind.text);
    if (kind.defect == &mesh.self_intersecting_triangles) {
      const double share = mesh.self_intersecting_share();
      text +=
          fmt::format(", {:.4g} % of all{}", 100.0 * share, share <= max_self_intersecting_share ? ", tolerated" : "");
    }
    text += ":\n";
    for (const MeshPlace& place : kind.defect->places) {
      text += fmt::format("    {}\n", describe_place(kind.element, place));
    }
    if (kind.defect->count > kind.defect->places.size()) text += "    …\n";
  }
  return text;
}

}  // namespace

std::string to_text(const FileCheck& check, double max_self_intersecting_share) {
  std::string text =
      fmt::format("{}: {}\n", check.path, is_sound(check, max_self_intersecting_share) ? "ok" : "DEFECTS");
  if (check.mesh.triangles == 0) return text + "  it has no triangles\n";
  text += sizes_of(check.mesh);
  if (!check.has_indices) text += "  the format has no indices: vertices of the same position were joined\n";
  text += components_of(check.mesh) + defects_of(check.mesh, max_self_intersecting_share);
  if (!check.welded) return text;
  text += fmt::format("  with {} vertices joined to others of the same position:\n", check.merged_vertices);
  const std::string defects = defects_of(*check.welded, max_self_intersecting_share);
  return text + sizes_of(*check.welded) + (defects.empty() ? "  no defects\n" : defects);
}

}  // namespace particle_surface_tracker
