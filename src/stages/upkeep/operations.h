#pragma once

#include <cstdint>
#include <optional>

#include "editable_surface.h"
#include "guards.h"
#include "patch.h"
#include "surroundings.h"
#include "tolerances.h"

namespace particle_surface_tracker {

/// Splits, collapses and flips of single edges, each done only if all its guards agree.
class Operations {
 public:
  /// \param size cell size h of Γ [m].
  Operations(EditableSurface& surface, const BirthRecords& births, const Tolerances& tolerances, double size);

  /// Where to split an edge: on a smooth part where the butterfly scheme says, else at its midpoint.
  Vec3f split_position(std::uint32_t half_edge) const;

  /// Splits an edge at a position, or at its midpoint if the guards do not agree with that.
  /// \return the new vertex, or kNone.
  std::uint32_t split(std::uint32_t half_edge, Vec3f position);

  /// Collapses an edge: onto a ridge or corner vertex, else to where the butterfly scheme puts its middle, else onto
  /// one of its ends; if the guards agree with none of these, to another of these places.
  /// \return the vertex that is left, or kNone.
  std::uint32_t collapse(std::uint32_t half_edge);

  /// Flips an edge where that makes the smallest angle of its two triangles larger.
  bool flip(std::uint32_t half_edge);

  /// How often so far an operation was refused because the surface would have crossed itself.
  std::size_t crossings() const { return crossings_; }

  static constexpr std::uint32_t kNone = 0xffffffffU;

 private:
  bool is_on_ridge(std::uint32_t half_edge) const;
  Vec3f smooth_position(std::uint32_t half_edge) const;
  bool may_split_at(std::uint32_t half_edge, const Vec3f& position);
  bool may_collapse_to(std::uint32_t half_edge, const Vec3f& position);
  bool may_flip(std::uint32_t half_edge);
  bool is_clear();
  double volume_limit(std::uint32_t half_edge) const;
  void enter_around(std::uint32_t vertex);

  EditableSurface& surface_;
  const BirthRecords& births_;
  const Tolerances& tolerances_;
  double size_;
  std::optional<Surroundings> surroundings_;  // made when first needed
  PlannedPatch patch_;
  std::size_t crossings_ = 0;
  std::vector<std::uint32_t> indices_;  // memory for searches
  std::vector<NearTriangle> near_;      // the same
};

}  // namespace particle_surface_tracker
