#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace particle_surface_tracker {

/// Who an attribute is for.
enum class AttributeUse {
  kOutput,   ///< Written to files and messages.
  kInternal  ///< What a stage remembers of a vertex from frame to frame.
};

/// One array of values carried by the vertices of a mesh, for instance δ, a colour or texture coordinates.
struct VertexAttribute {
  std::string name;
  std::size_t components = 1;        ///< Numbers per vertex.
  std::vector<float> initial_value;  ///< What a vertex gets that has nothing to inherit from; `components` numbers.
  std::vector<float> values;         ///< `components` numbers per vertex, vertex by vertex.
  AttributeUse use = AttributeUse::kOutput;
};

/// Vertices and weights that a new vertex is blended from. The weights sum to 1.
using VertexBlend = std::vector<std::pair<std::uint32_t, double>>;

/// All attributes of a mesh, kept in step with its vertices through every operation: whoever adds, blends or removes a
/// vertex calls one function here and every registered attribute follows. Attributes keep the order of registration.
class VertexAttributes {
 public:
  /// Adds an attribute and fills it with its initial value, or returns the one of that name if it is there already.
  /// \return its index, valid for as long as this object lives.
  /// \throw MeshError if components is 0, differs from initial_value's length, or from that of an attribute of the
  /// name.
  std::size_t add(const std::string& name, std::size_t components, std::vector<float> initial_value,
                  AttributeUse use = AttributeUse::kOutput);

  /// Index of the attribute of that name, or `none`.
  std::size_t find(const std::string& name) const;
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  std::size_t count() const { return attributes_.size(); }
  VertexAttribute& operator[](std::size_t index) { return attributes_[index]; }
  const VertexAttribute& operator[](std::size_t index) const { return attributes_[index]; }

  std::size_t vertex_count() const { return vertex_count_; }

  /// Changes the number of vertices at the end; new ones get the initial values.
  void resize(std::size_t vertex_count);

  /// Appends one vertex whose values are a weighted mean of those of others.
  void append_blend(const VertexBlend& blend);

  /// Replaces the values of one vertex by a weighted mean of those of others, of which it may be one itself.
  void set_blend(std::uint32_t vertex, const VertexBlend& blend);

  /// Keeps the vertices `kept` (strictly increasing indices), in that order, and drops all others.
  void keep(const std::vector<std::uint32_t>& kept);

 private:
  std::vector<VertexAttribute> attributes_;
  std::size_t vertex_count_ = 0;
};

}  // namespace particle_surface_tracker
