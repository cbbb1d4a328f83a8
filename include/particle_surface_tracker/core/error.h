#pragma once

#include <stdexcept>
#include <string>

namespace particle_surface_tracker {

/// Base of everything this library throws on purpose. The text names the thing, the value and what to do.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A parameter that is unknown, out of its range or not a number.
class ParameterError : public Error {
 public:
  using Error::Error;
};

/// A particle frame that cannot be used: positions that are not finite, ids that occur twice, arrays of different
/// lengths.
class ParticleError : public Error {
 public:
  using Error::Error;
};

/// A mesh that cannot be tracked: open, not manifold, inconsistently oriented, empty, not finite.
class MeshError : public Error {
 public:
  using Error::Error;
};

/// Particles and mesh are good by themselves but do not belong together, or a frame could not be tracked.
class TrackingError : public Error {
 public:
  using Error::Error;
};

/// A file or message that cannot be read.
class InputError : public Error {
 public:
  using Error::Error;
};

/// A file or folder that cannot be written.
class OutputError : public Error {
 public:
  using Error::Error;
};

}  // namespace particle_surface_tracker
