// check_mesh: says whether mesh files hold closed, oriented manifolds without self-intersections, and what is wrong.

#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "file_check.h"
#include "particle_surface_tracker/core/error.h"

namespace pst = particle_surface_tracker;

namespace {

enum ExitCode { kOk = 0, kUsage = 1, kInput = 2, kDefects = 3 };

struct Options {
  std::vector<std::string> files;
  double max_self_intersections = 0.0;
  bool json = false;
};

/// How bad one file is; a defect is less than a file that nothing can be said about.
ExitCode check(const std::string& path, const Options& options) {
  try {
    const pst::FileCheck found = pst::check_file(path);
    std::cout << (options.json ? pst::to_json(found, options.max_self_intersections)
                               : pst::to_text(found, options.max_self_intersections))
              << std::flush;
    return pst::is_sound(found, options.max_self_intersections) ? kOk : kDefects;
  } catch (const pst::InputError& error) {
    if (options.json) std::cout << pst::error_to_json(path, error.what()) << std::flush;
    std::cerr << "check_mesh: " << error.what() << std::endl;
    return kInput;
  }
}

int check_all(const Options& options) {
  bool any_unread = false;
  bool any_defects = false;
  for (const std::string& path : options.files) {
    const ExitCode code = check(path, options);
    any_unread |= code == kInput;
    any_defects |= code == kDefects;
  }
  if (!std::cout) {
    std::cerr << "check_mesh: cannot write the result" << std::endl;
    return kInput;
  }
  return any_unread ? kInput : any_defects ? kDefects : kOk;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Checks mesh files: closed, manifold, oriented, self-intersections, nesting of components.",
               "check_mesh");
  app.set_version_flag("--version", "check_mesh " PST_VERSION);
  app.add_option("FILE", options.files, "Meshes: PLY, OFF, OBJ or STL")->required();
  app.add_option("--max-self-intersections", options.max_self_intersections,
                 "Share of self-intersecting triangles that is no defect")
      ->type_name("SHARE")
      ->check([](const std::string& text) {
        const double share = std::strtod(text.c_str(), nullptr);
        return share >= 0.0 && share <= 1.0 ? "" : "expected a number from 0 to 1, not " + text;
      })
      ->capture_default_str();
  app.add_flag("--json", options.json, "Print one JSON object per file and line");
  app.footer("Exit codes: 0 ok, 1 usage, 2 a file cannot be read, 3 a mesh has defects.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kOk : kUsage;
  }
  try {
    return check_all(options);
  } catch (const std::exception& error) {
    std::cerr << "check_mesh: " << error.what() << std::endl;
    return kInput;
  }
}
