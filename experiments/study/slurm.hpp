// SPDX-License-Identifier: BSD-3-Clause
// Job scripts that carry out a study in shards: by Slurm, or by GNU parallel on several hosts.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace polhode::study {

/// The user's choices for the jobs. An empty text leaves the choice to the site.
struct SlurmJobs {
  std::size_t shards = 0;  ///< tasks of the job array
  std::size_t cpus = 1;    ///< cores of a task
  std::string time, memory, account, partition;
  std::size_t warning = 60;          ///< time between the warning (SIGUSR1) and the time limit, s
  std::size_t rounds = 3;            ///< most submissions of the array: one, and again while runs are missing
  std::vector<std::string> options;  ///< further options of sbatch, such as --qos=long
};

/// Reads "shards=64 time=2:00:00 mem=2G". `runs`: number of runs of the study, of which there are at most as many
/// shards. Throws InputError: an unknown key, no number, or more shards than the site's MaxArraySize allows.
SlurmJobs read_slurm_jobs(const std::string& text, std::size_t runs);

/// Writes array.sh, merge.sh, submit.sh and parallel.sh into the folder slurm of the results folder. `words`: options
/// of the experiment's command line besides --shard and --merge. Throws WriteError.
void write_job_scripts(const SlurmJobs& jobs, const std::string& experiment, const std::vector<std::string>& words,
                       const std::filesystem::path& results);

/// Submits the scripts. Returns what sbatch printed. Throws std::runtime_error if it is not there or refuses them.
std::string submit_jobs(const std::filesystem::path& results);

}  // namespace polhode::study
