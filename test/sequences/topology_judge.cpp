#include "sequences/topology_judge.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

namespace particle_surface_tracker::test {

namespace {

constexpr std::uint32_t kNone = SurfaceBodies::kNone;

/// How bodies of the mesh and of φ = 0 correspond.
struct Correspondence {
  BodyLinks links;
  std::vector<bool> mesh_is_right;
  std::vector<bool> phi_is_right;    ///< Has exactly one partner, or too few particles to be compared.
  std::vector<bool> phi_is_missing;  ///< Has enough particles, and no partner.
};

bool is_compared(const Membership& phi, std::uint32_t body) {
  return phi.sizes[body] >= kFewestParticles;
}

/// Links bodies of the mesh that no particle links, by the place of a vertex.
void link_by_place(const SurfaceBodies& mesh, const SurfaceBodies& phi, double reach, BodyLinks& links) {
  for (std::uint32_t m = 0; m < mesh.size(); ++m) {
    if (!links.of_first[m].empty()) continue;
    links.of_first[m] = phi.bodies_of(mesh.vertex_of(m), reach);
    for (const std::uint32_t f : links.of_first[m]) links.of_second[f].push_back(m);
  }
}

Correspondence compare(const SurfaceBodies& mesh, const Membership& mesh_members, const SurfaceBodies& phi,
                       const Membership& phi_members, double reach) {
  BodyLinks links = link_bodies(mesh_members, phi_members);
  link_by_place(mesh, phi, reach, links);
  Correspondence found;
  found.links = links;
  for (std::uint32_t m = 0; m < mesh.size(); ++m) {
    std::vector<std::uint32_t> compared;
    std::copy_if(links.of_first[m].begin(), links.of_first[m].end(), std::back_inserter(compared),
                 [&](std::uint32_t f) { return is_compared(phi_members, f); });
    const bool is_small = compared.empty() && (!links.of_first[m].empty() || mesh_members.sizes[m] > 0);
    const bool has_one_partner = compared.size() == 1 && links.of_second[compared.front()].size() == 1;
    found.mesh_is_right.push_back(is_small || has_one_partner);
  }
  for (std::uint32_t f = 0; f < phi.size(); ++f) {
    const std::vector<std::uint32_t>& partners = links.of_second[f];
    const bool has_one_partner = partners.size() == 1 && found.mesh_is_right[partners.front()];
    found.phi_is_right.push_back(!is_compared(phi_members, f) || has_one_partner);
    found.phi_is_missing.push_back(is_compared(phi_members, f) && partners.empty());
  }
  return found;
}

/// Calls visit(first, second) with the places of every particle that two frames have in common.
template <typename Visit>
void for_common_particles(const Membership& first, const Membership& second, Visit&& visit) {
  std::size_t b = 0;
  for (std::size_t a = 0; a < first.ids.size(); ++a) {
    while (b < second.ids.size() && second.ids[b] < first.ids[a]) ++b;
    if (b < second.ids.size() && second.ids[b] == first.ids[a]) visit(a, b);
  }
}

/// The body of the frame before that most particles of a body come from; kNone if most come from none, or are new.
std::uint32_t origin_of(std::uint32_t body, const Membership& now, const Membership& earlier) {
  std::map<std::uint32_t, std::size_t> votes;
  for_common_particles(now, earlier, [&](std::size_t a, std::size_t b) {
    if (!std::binary_search(now.bodies[a].begin(), now.bodies[a].end(), body)) return;
    for (const std::uint32_t origin : earlier.bodies[b]) ++votes[origin];
  });
  for (const auto& [origin, count] : votes) {
    if (2 * count > now.sizes[body]) return origin;
  }
  return kNone;
}

/// Number of links beyond the first, over all bodies that are compared.
std::size_t count_beyond_first(const std::vector<std::vector<std::uint32_t>>& links, const Membership& here,
                               const Membership& there) {
  std::size_t beyond = 0;
  for (std::uint32_t body = 0; body < links.size(); ++body) {
    if (!is_compared(here, body)) continue;
    const auto compared = std::count_if(links[body].begin(), links[body].end(),
                                        [&](std::uint32_t other) { return is_compared(there, other); });
    beyond += static_cast<std::size_t>(std::max<std::ptrdiff_t>(compared - 1, 0));
  }
  return beyond;
}

std::vector<Vec3f> find_uncovered(const SurfaceBodies& mesh, const Membership& phi, const ParticleFrame& particles,
                                  double r) {
  std::vector<Vec3f> uncovered;
  for (std::size_t n = 0; n < particles.size(); ++n) {
    const Vec3f& place = particles.positions[n];
    const bool is_of_interest = std::any_of(phi.bodies[n].begin(), phi.bodies[n].end(),
                                            [&](std::uint32_t body) { return is_compared(phi, body); });
    if (!is_of_interest || mesh.judge().winding_number(place) > 0) continue;
    if (mesh.size() == 0 || mesh.judge().nearest(place).distance > r) uncovered.push_back(place);
  }
  return uncovered;
}

}  // namespace

Membership find_membership(const SurfaceBodies& bodies, const ParticleFrame& particles, double reach) {
  Membership membership;
  membership.ids = particles.ids;
  membership.bodies = bodies.bodies_of(particles.positions, reach);
  membership.sizes.assign(bodies.size(), 0);
  for (const std::vector<std::uint32_t>& of_particle : membership.bodies) {
    for (const std::uint32_t body : of_particle) ++membership.sizes[body];
  }
  return membership;
}

BodyLinks link_bodies(const Membership& first, const Membership& second) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> common;
  for_common_particles(first, second, [&](std::size_t a, std::size_t b) {
    for (const std::uint32_t one : first.bodies[a]) {
      for (const std::uint32_t other : second.bodies[b]) ++common[{one, other}];
    }
  });
  BodyLinks links;
  links.of_first.resize(first.sizes.size());
  links.of_second.resize(second.sizes.size());
  for (const auto& [pair, count] : common) {
    const auto& [one, other] = pair;
    if (count < kFewestParticles && 2 * count < std::min(first.sizes[one], second.sizes[other])) continue;
    links.of_first[one].push_back(other);
    links.of_second[other].push_back(one);
  }
  return links;
}

TopologyJudgement TopologyJudge::judge(const SurfaceBodies& mesh, std::shared_ptr<const SurfaceBodies> phi,
                                       const ParticleFrame& particles) {
  const Membership mesh_members = find_membership(mesh, particles, r_);
  Membership phi_members = find_membership(*phi, particles, r_);
  const Correspondence now = compare(mesh, mesh_members, *phi, phi_members, r_);

  TopologyJudgement judgement;
  judgement.mesh_bodies = mesh.size();
  judgement.mesh_cavities = mesh.cavities();
  judgement.nested_solids = mesh.nested_solids();
  judgement.misplaced_cavities = mesh.misplaced_cavities();
  for (std::uint32_t f = 0; f < phi->size(); ++f) {
    ++(is_compared(phi_members, f) ? judgement.phi_bodies : judgement.small_phi_bodies);
  }
  judgement.uncovered = find_uncovered(mesh, phi_members, particles, r_);

  Correspondence before;
  if (earlier_phi_) {
    before = compare(mesh, mesh_members, *earlier_phi_, earlier_membership_, r_);
    const BodyLinks succession = link_bodies(earlier_membership_, phi_members);
    judgement.splits = count_beyond_first(succession.of_first, earlier_membership_, phi_members);
    judgement.merges = count_beyond_first(succession.of_second, phi_members, earlier_membership_);
  }
  for (std::uint32_t m = 0; m < mesh.size(); ++m) {
    if (now.mesh_is_right[m]) continue;
    ++judgement.wrong_now;
    if (earlier_phi_ && before.mesh_is_right[m]) continue;
    ++judgement.wrong;
    WrongBody body{true, mesh.vertex_of(m), mesh_members.sizes[m], {}};
    for (const std::uint32_t f : now.links.of_first[m]) body.partners.push_back(phi->vertex_of(f));
    judgement.wrong_bodies.push_back(std::move(body));
  }
  for (std::uint32_t f = 0; f < phi->size(); ++f) {
    if (!now.phi_is_missing[f]) continue;
    ++judgement.wrong_now;
    // One that has just come off another body, or out of nothing, may be late.
    const std::uint32_t origin = earlier_phi_ ? origin_of(f, phi_members, earlier_membership_) : kNone;
    const bool may_be_late = earlier_phi_ && (origin == kNone || before.phi_is_right[origin]);
    if (may_be_late) continue;
    ++judgement.wrong;
    judgement.wrong_bodies.push_back({false, phi->vertex_of(f), phi_members.sizes[f], {}});
  }

  earlier_phi_ = std::move(phi);
  earlier_membership_ = std::move(phi_members);
  return judgement;
}

}  // namespace particle_surface_tracker::test
