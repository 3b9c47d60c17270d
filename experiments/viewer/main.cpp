// SPDX-License-Identifier: BSD-3-Clause
// How does a scenario move? A window to watch it in, pictures and films of it, and sessions that can be run again.
#include <fmt/format.h>

#include "experiments/study/plan/listing.hpp"
#include "experiments/study/text/program.hpp"
#include "experiments/viewer/options.hpp"

namespace polhode::viewer {
namespace {

int run_again(const std::string& file) {
  const Rerun again = rerun(file);
  fmt::print("{} segments, {} steps to t = {} s; state {}\n", again.segments, again.steps, again.end.t, again.digest);
  if (again.mismatch.empty()) return 0;
  fmt::print(stderr, "viewer: {}\n", again.mismatch);
  return 3;
}

int run(int argc, char** argv) {
  const Options options = parse("How does a scenario move? A window to watch it in.", argc, argv);
  if (options.exit_status) return *options.exit_status;
  if (options.list) {
    fmt::print("{}", study::listing(*options.list));
    return 0;
  }
  if (!options.rerun.empty()) return run_again(options.rerun);
  if (!options.offscreen) {
    show_window(options.stage, options.window);
    return 0;
  }
  const int pictures = show_offscreen(options.stage, options.pictures);
  fmt::print("{} picture{} in {}\n", pictures, pictures == 1 ? "" : "s",
             options.pictures.frames ? options.pictures.out.string() : options.pictures.film.string());
  return 0;
}

}  // namespace
}  // namespace polhode::viewer

int main(int argc, char** argv) {
  return polhode::study::run_program("viewer", [&] { return polhode::viewer::run(argc, argv); });
}
