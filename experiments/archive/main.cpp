// SPDX-License-Identifier: BSD-3-Clause
// What is there of the trajectories in a folder of results, and what can be saved of those that are not whole?
#include <fmt/format.h>

#include "experiments/archive/archive.hpp"
#include "experiments/archive/options.hpp"
#include "experiments/study/text/program.hpp"

int main(int argc, char** argv) {
  using namespace polhode::study;
  return run_program("archive", [&] {
    const archive::ArchiveOptions options = archive::parse_archive_options(argc, argv);
    if (options.exit_status) return *options.exit_status;
    const archive::Inventory inventory =
        options.repair ? archive::repair(options.folder) : archive::check(options.folder);
    fmt::print("{}", inventory.text);
    return inventory.all_well ? 0 : archive::not_whole;
  });
}
