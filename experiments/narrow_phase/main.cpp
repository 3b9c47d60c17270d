// SPDX-License-Identifier: BSD-3-Clause
// Do the narrow phases agree, what do they cost, and how often does the course report's test err?
#include <fmt/format.h>

#include <cstdio>
#include <stdexcept>

#include "experiments/narrow_phase/options.hpp"
#include "experiments/narrow_phase/pairs.hpp"
#include "experiments/study/input_error.hpp"
#include "experiments/study/listing.hpp"
#include "experiments/study/suggestion.hpp"
#include "experiments/study/text_file.hpp"

namespace polhode::study {
namespace {

const NarrowPhaseEntry& entry(const std::string& name) {
  if (const NarrowPhaseEntry* found = find_narrow_phase(name)) return *found;
  std::vector<std::string_view> known;
  for (const NarrowPhaseEntry& e : narrow_phase_catalogue()) known.emplace_back(e.name);
  throw InputError("--narrow-phase: no narrow phase '" + name + "'" + suggestion(name, "There are", known));
}

void answer_pairs(const NarrowPhaseOptions& options) {
  const auto narrow_phase = entry(options.narrow_phase.empty() ? "sat" : options.narrow_phase).make();
  const std::string text = answers(read_pairs(options.pairs), *narrow_phase);
  if (options.out.empty()) {
    fmt::print("{}", text);
  } else {
    write_text(options.out, text);
  }
}

int run(int argc, char** argv) {
  const auto options = parse_narrow_phase_options(
      "Do the narrow phases agree, what do they cost, and how often does the course report's test err?", argc, argv);
  if (options.exit_status) return *options.exit_status;
  if (options.list) {
    fmt::print("{}", listing(*options.list));
    return 0;
  }
  if (!options.pairs.empty()) answer_pairs(options);
  return 0;
}

}  // namespace
}  // namespace polhode::study

int main(int argc, char** argv) {
  try {
    return polhode::study::run(argc, argv);
  } catch (const polhode::study::InputError& error) {
    fmt::print(stderr, "narrow_phase: {}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "narrow_phase: {}\n", error.what());
    return 3;
  }
}
