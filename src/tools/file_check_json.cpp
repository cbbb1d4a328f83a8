#include <nlohmann/json.hpp>

#include "file_check.h"

namespace particle_surface_tracker {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Vec3f& position) {
  return {position.x(), position.y(), position.z()};
}

Json to_json(const MeshDefect& defect) {
  Json places = Json::array();
  for (const MeshPlace& place : defect.places) {
    Json json = {{"index", place.index}, {"position", to_json(place.position)}};
    if (place.other != place.index) {
      json["other"] = place.other;
      json["other_position"] = to_json(place.other_position);
    }
    places.push_back(std::move(json));
  }
  return {{"count", defect.count}, {"places", std::move(places)}};
}

Json to_json(const MeshComponent& component) {
  return {{"first_vertex", component.first_vertex},
          {"vertices", component.vertices},
          {"triangles", component.triangles},
          {"closed", component.is_closed},
          {"manifold", component.is_manifold},
          {"genus", component.genus},
          {"volume", component.volume},
          {"area", component.area},
          {"winding_around", component.winding_around}};
}

Json to_json(const MeshCheck& mesh) {
  Json json = {{"vertices", mesh.vertices}, {"triangles", mesh.triangles},
               {"genus", mesh.genus()},     {"volume", mesh.volume()},
               {"area", mesh.area()},       {"self_intersecting_share", mesh.self_intersecting_share()}};
  json["defects"] = Json::object();
  for (const NamedMeshDefect& kind : list_defects(mesh)) json["defects"][kind.name] = to_json(*kind.defect);
  json["components"] = Json::array();
  for (const MeshComponent& component : mesh.components) json["components"].push_back(to_json(component));
  return json;
}

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string to_json(const FileCheck& check, double max_self_intersecting_share) {
  Json json = {{"file", check.path}, {"sound", is_sound(check, max_self_intersecting_share)}};
  json["has_indices"] = check.has_indices;
  json["mesh"] = to_json(check.mesh);
  json["merged_vertices"] = check.merged_vertices;
  if (check.welded) json["welded"] = to_json(*check.welded);
  return text_of(json);
}

std::string error_to_json(const std::string& path, const std::string& error) {
  return text_of(Json{{"file", path}, {"error", error}});
}

}  // namespace particle_surface_tracker
