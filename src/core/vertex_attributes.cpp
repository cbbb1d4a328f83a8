#include "particle_surface_tracker/core/vertex_attributes.h"

#include <algorithm>

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {

namespace {

float blended(const VertexAttribute& attribute, std::size_t component, const VertexBlend& blend) {
  double value = blend.empty() ? attribute.initial_value[component] : 0.0;
  for (const auto& [vertex, weight] : blend) {
    value += weight * attribute.values[vertex * attribute.components + component];
  }
  return static_cast<float>(value);
}

}  // namespace

std::size_t VertexAttributes::add(const std::string& name, std::size_t components, std::vector<float> initial_value,
                                  AttributeUse use) {
  if (components == 0 || initial_value.size() != components) {
    throw MeshError(
        fmt::format("vertex attribute '{}': {} components with an initial value of {} numbers; both must be "
                    "equal and at least 1",
                    name, components, initial_value.size()));
  }
  const std::size_t existing = find(name);
  if (existing != none) {
    if (attributes_[existing].components != components) {
      throw MeshError(fmt::format("vertex attribute '{}' has {} components already and cannot be added with {}", name,
                                  attributes_[existing].components, components));
    }
    return existing;
  }
  VertexAttribute attribute{name, components, std::move(initial_value), {}, use};
  attribute.values.reserve(vertex_count_ * components);
  for (std::size_t v = 0; v < vertex_count_; ++v) {
    attribute.values.insert(attribute.values.end(), attribute.initial_value.begin(), attribute.initial_value.end());
  }
  attributes_.push_back(std::move(attribute));
  return attributes_.size() - 1;
}

std::size_t VertexAttributes::find(const std::string& name) const {
  for (std::size_t i = 0; i < attributes_.size(); ++i) {
    if (attributes_[i].name == name) return i;
  }
  return none;
}

void VertexAttributes::resize(std::size_t vertex_count) {
  for (VertexAttribute& attribute : attributes_) {
    attribute.values.reserve(vertex_count * attribute.components);
    attribute.values.resize(std::min(vertex_count, vertex_count_) * attribute.components);
    for (std::size_t v = vertex_count_; v < vertex_count; ++v) {
      attribute.values.insert(attribute.values.end(), attribute.initial_value.begin(), attribute.initial_value.end());
    }
  }
  vertex_count_ = vertex_count;
}

void VertexAttributes::append_blend(const VertexBlend& blend) {
  for (VertexAttribute& attribute : attributes_) {
    for (std::size_t c = 0; c < attribute.components; ++c) attribute.values.push_back(blended(attribute, c, blend));
  }
  ++vertex_count_;
}

void VertexAttributes::set_blend(std::uint32_t vertex, const VertexBlend& blend) {
  for (VertexAttribute& attribute : attributes_) {
    for (std::size_t c = 0; c < attribute.components; ++c) {
      attribute.values[vertex * attribute.components + c] = blended(attribute, c, blend);
    }
  }
}

void VertexAttributes::keep(const std::vector<std::uint32_t>& kept) {
  for (VertexAttribute& attribute : attributes_) {
    auto to = attribute.values.begin();
    for (const std::uint32_t vertex : kept) {
      const auto from = attribute.values.begin() + static_cast<std::ptrdiff_t>(vertex * attribute.components);
      to = std::copy(from, from + static_cast<std::ptrdiff_t>(attribute.components), to);
    }
    attribute.values.erase(to, attribute.values.end());
  }
  vertex_count_ = kept.size();
}

}  // namespace particle_surface_tracker
