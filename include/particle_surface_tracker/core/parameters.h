#pragma once

#include <string>
#include <vector>

namespace particle_surface_tracker {

/// How the motion of the particles is carried over to the vertices (Sec. 4).
enum class AdvectionMethod {
  kAverage,  ///< Weighted average of the displacements, as in the paper.
  kAffine    ///< First-order fit of the displacements: exact for rigid motion.
};

/// How a vertex is projected onto the isosurface φ = δ (Sec. 5.2).
enum class ProjectionMethod {
  kTwoStep,  ///< To φ = 0 in small steps, then back by δ, as in the paper.
  kOneStep   ///< Equation 1 of the paper, which the two-step projection improves on; for comparison.
};

/// How the Poisson equation of topology matching is solved (Sec. 6.1).
enum class MatchingSolver {
  kSor,  ///< Successive over-relaxation, as in the paper.
  kPcg   ///< Conjugate gradients, preconditioned with an incomplete Cholesky factorisation.
};

/// What is taken for a change of topology (Sec. 5.3).
enum class DetectionMethod {
  kTau,         ///< A projection that moves a vertex by more than τ, as in the paper.
  kTauAndSigns  ///< Also nodes where mesh and isosurface disagree about inside and outside.
};

/// When topology matching looks at the surface (Sec. 9.3).
enum class MatchingFrames {
  kFlagged,  ///< Where and when something is flagged.
  kEvery     ///< Everywhere in every frame.
};

/// What becomes of triangles that cross each other within a cell of Γ, where Γ does not see it.
enum class SelfIntersections {
  kKeep,   ///< They stay, unless mesh upkeep can relax them.
  kRemesh  ///< Their cells are made anew (Sec. 7).
};

/// What becomes of δ where the surface is drawn out.
enum class StretchedDetail {
  kKeep,  ///< It stays, as in the paper.
  kThin   ///< It shrinks as the area around it grows, so that detail keeps its volume.
};

/// Whether the mesh follows the topology of the particles (Secs. 6 to 8).
enum class TopologyMode {
  kKeep,  ///< Its connectivity never changes: what would split or merge is put back and reported (Sec. 5.3).
  kMatch  ///< It splits and merges, and its triangles are kept in shape.
};

/// Everything a user can set. Lengths are multiples of the particle spacing r unless a field says otherwise; the symbol
/// of the paper stands first. Names, units, ranges and texts for users are in parameter_table().
struct Parameters {
  // r: distance between neighbouring particles at rest [m]. Has no default.
  double particle_spacing = 0.0;

  // Advection (Sec. 4).
  AdvectionMethod advection = AdvectionMethod::kAffine;
  double advection_radius = 2.0;        // Influence radius of the poly6 kernel [r].
  double max_displacement = 10.0;       // A particle that moves farther in a frame counts as gone and born [r].
  int affine_min_neighbors = 12;        // The radius grows until it holds that many.
  double affine_max_radius = 4.0;       // ... but not beyond this [r].
  double affine_rank_threshold = 0.03;  // Eigenvalues of the neighbours' covariance that count [r²].
  double affine_max_residual = 0.02;    // Beyond this misfit (RMS) the fit gives way to the average [r].
  double affine_max_stretch = 0.25;     // Stretches of the fitted motion are clamped to 1 ± this.

  // Implicit function (Sec. 5.1), after Solenthaler et al. 2007.
  double dx_phi = 0.5;            // Δx_φ: cell size of φ [r].
  double influence_radius = 4.0;  // R: radius of the averaging kernel [r].
  double surface_radius = 1.04;   // r̄: puts φ = 0 where a flat body of liquid ends [r].
  double eigenvalue_low = 0.4;    // t_low: below it the surface radius is not attenuated.
  double eigenvalue_high = 2.0;   // t_high: above it the attenuated radius is 0.
  double band_factor = 1.25;      // Reach of φ over the previous largest distance between mesh and isosurface.
  double max_reach = 8.0;         // A vertex farther from the isosurface has lost it [r].

  // Projection and detection (Secs. 5.2, 5.3).
  ProjectionMethod projection = ProjectionMethod::kTwoStep;
  double epsilon = 0.35;                // ε: part of the distance travelled in one step, in (0, 1].
  double projection_tolerance = 0.005;  // The search for φ = 0 ends when |φ| is below this [Δx_φ].
  int projection_max_steps = 100;       // ... or after this many steps.
  double tau = 0.5;                     // τ: a projection that moves a vertex farther is a topological change [r].

  // Voxelisation Γ of the mesh and topology matching (Secs. 5.3, 6).
  TopologyMode topology = TopologyMode::kMatch;
  double dx_gamma = 0.5;  // Δx_Γ: cell size of Γ [r].
  DetectionMethod detection = DetectionMethod::kTauAndSigns;
  double matching_reach = 1.0;  // Γ may change this far from what is flagged; 0: anywhere [r].
  MatchingFrames matching_frames = MatchingFrames::kFlagged;
  MatchingSolver matching_solver = MatchingSolver::kSor;
  double beta = 0.01;  // β: the SOR solver ends when no step is longer [Δx_Γ].

  SelfIntersections self_intersections = SelfIntersections::kKeep;

  // Mesh upkeep (Sec. 8): limits that must all be passed, against neighbours and against the mesh at its birth.
  double split_length = 1.5;        // A longer edge is split [Δx_Γ],
  double split_growth = 2.0;        // ... if it is longer than this times the edges at birth.
  double collapse_length = 0.2;     // A shorter edge is collapsed [Δx_Γ],
  double collapse_shrinkage = 0.3;  // ... if it is shorter than this times the edges at birth.
  double remeshed_length = 0.5;     // Where re-meshing made both ends, a shorter edge is collapsed [Δx_Γ].
  double fold_angle = 160.0;        // An edge whose triangles' normals differ by more is collapsed [deg].
  double sliver_angle = 10.0;       // A triangle with a smaller angle is removed [deg].

  StretchedDetail stretched_detail = StretchedDetail::kThin;
  double delta_half_life = 0.0;  // Time in which δ halves [s]; 0: it never changes.
};

/// What a user needs to know about one parameter; the one source for command line, YAML, dynamic_reconfigure and docs.
struct ParameterInfo {
  enum class Type { kReal, kInteger, kChoice };

  std::string name{};    ///< The field of Parameters.
  std::string symbol{};  ///< In the paper, or empty.
  std::string unit{};    ///< For instance "r", "m", or empty.
  std::string text{};    ///< One sentence.
  Type type = Type::kReal;
  double minimum = 0.0;                ///< Smallest valid value (kReal, kInteger).
  double maximum = 0.0;                ///< Largest valid value (kReal, kInteger).
  double slider_maximum = 0.0;         ///< Where a slider may end: larger values are valid, but rarely of use.
  std::vector<std::string> choices{};  ///< Valid values (kChoice).
  bool needs_reset = false;            ///< True where a new value cannot be applied while a mesh is being tracked.
};

/// All parameters in the order of the struct.
const std::vector<ParameterInfo>& parameter_table();

/// The value of one parameter as text that set_parameter() reads back exactly.
/// \throw ParameterError if there is no parameter of that name.
std::string get_parameter(const Parameters& parameters, const std::string& name);

/// Sets one parameter from text.
/// \throw ParameterError if there is no parameter of that name (the nearest name is suggested), or the text is not a
/// number or choice of the right kind, or the value is out of range. `parameters` is unchanged then.
void set_parameter(Parameters& parameters, const std::string& name, const std::string& value);

/// Checks every value and how they fit together (eigenvalue_low < eigenvalue_high, affine_max_radius ≥
/// advection_radius).
/// \throw ParameterError that names the parameter, its value and the range.
void check_parameters(const Parameters& parameters);

}  // namespace particle_surface_tracker
