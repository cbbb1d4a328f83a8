#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "particle_surface_tracker/core/particle_frame.h"
#include "particle_surface_tracker/core/types.h"
#include "sequences/surface_bodies.h"

namespace particle_surface_tracker::test {

/// A φ component that holds fewer particles is not compared with the mesh.
constexpr std::size_t kFewestParticles = 8;

/// Which bodies the particles of a frame are in.
struct Membership {
  std::vector<std::uint32_t> ids;                  ///< Of the particles, increasing.
  std::vector<std::vector<std::uint32_t>> bodies;  ///< Of every particle, increasing.
  std::vector<std::size_t> sizes;                  ///< Particles of every body.
};

/// Which bodies of two surfaces are the same liquid: those that have eight particles in common, or half of the
/// particles of the smaller one. The particles may be those of two frames; they are matched by id.
struct BodyLinks {
  std::vector<std::vector<std::uint32_t>> of_first;   ///< For every body of the first surface, those of the second.
  std::vector<std::vector<std::uint32_t>> of_second;  ///< The other way round.
};

Membership find_membership(const SurfaceBodies& bodies, const ParticleFrame& particles, double reach);
BodyLinks link_bodies(const Membership& first, const Membership& second);

/// A body of mesh or φ = 0 without exactly one partner: where it is, for people who look.
struct WrongBody {
  bool is_of_mesh = false;
  Vec3f vertex = Vec3f::Zero();  ///< One of its own [m].
  std::size_t particles = 0;
  std::vector<Vec3f> partners;  ///< A vertex of every body of the other surface that is linked to it [m].
};

/// How the components of a mesh compare with those of φ = 0.
struct TopologyJudgement {
  std::size_t mesh_bodies = 0;          ///< Solids of the mesh.
  std::size_t mesh_cavities = 0;        ///< Components of the mesh that bound air in liquid.
  std::size_t nested_solids = 0;        ///< Solids of the mesh inside a solid.
  std::size_t misplaced_cavities = 0;   ///< Cavities of the mesh that are not inside exactly one solid.
  std::size_t phi_bodies = 0;           ///< Of φ = 0, with kFewestParticles particles or more.
  std::size_t small_phi_bodies = 0;     ///< Of φ = 0, with fewer.
  std::size_t splits = 0;               ///< Since the frame before: bodies of φ = 0 that others came off.
  std::size_t merges = 0;               ///< Since the frame before: bodies of φ = 0 that others joined.
  std::size_t wrong_now = 0;            ///< Bodies of mesh and φ = 0 without exactly one partner in this frame.
  std::size_t wrong = 0;                ///< Of these: also not right by φ of the frame before.
  std::vector<WrongBody> wrong_bodies;  ///< Those counted in `wrong`.
  std::vector<Vec3f> uncovered;         ///< Particles of bodies with kFewestParticles or more: outside by more than r.

  bool is_equal() const { return wrong == 0; }
};

/// Compares the topology of a tracked mesh with that of φ = 0, frame by frame.
///
/// A particle belongs to the bodies that wind around it, or else to the nearest within r; a body of the mesh without
/// particles, and without a body of φ = 0 by particles, belongs to the bodies of φ = 0 that its first vertex is in, or
/// within r of. A body of the mesh is right if it is linked to one body of φ = 0 of enough particles, and that body to
/// no other one of the mesh; or if it is only linked to bodies of fewer particles, or holds fewer itself. A body of φ =
/// 0 of enough particles is wrong if no body of the mesh is linked to it. Each body may be right in this frame or by φ
/// = 0 of the frame before: then the mesh is one frame late at most.
class TopologyJudge {
 public:
  /// \param r particle spacing [m].
  explicit TopologyJudge(double r) : r_(r) {}

  /// Judges the next frame.
  TopologyJudgement judge(const SurfaceBodies& mesh, std::shared_ptr<const SurfaceBodies> phi,
                          const ParticleFrame& particles);

 private:
  double r_;
  std::shared_ptr<const SurfaceBodies> earlier_phi_;
  Membership earlier_membership_;
};

}  // namespace particle_surface_tracker::test
