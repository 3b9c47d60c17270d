// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/slurm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <functional>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "experiments/study/plan/assignments.hpp"
#include "experiments/study/text/child_process.hpp"
#include "experiments/study/text/command_line.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/suggestion.hpp"
#include "experiments/study/text/text_file.hpp"

namespace polhode::study {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t usual_shards = 64;
constexpr std::size_t usual_array_size = 1001;  // MaxArraySize of Slurm, unless a site sets another

/// Largest index of a job array at this site, or Slurm's own default if the site's cannot be read.
std::size_t largest_index() {
  std::size_t size = usual_array_size;
  if (auto asked = ChildProcess::start({"scontrol", "show", "config"}, ".", {})) {
    const std::string said = asked->wait().printed;
    std::smatch found;
    if (std::regex_search(said, found, std::regex("MaxArraySize *= *([0-9]+)"))) size = std::stoul(found[1]);
  }
  return size > 1 ? size - 1 : 1;
}

std::size_t whole_number(const std::string& text, const std::string& label) {
  std::size_t n = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), n);
  if (read.ec == std::errc() && read.ptr == text.data() + text.size() && n > 0) return n;
  throw InputError(label + ": '" + text + "' is no positive whole number");
}

/// Minutes of a time limit as Slurm takes it (sbatch(1), --time), rounded up; absent if it is none.
std::optional<std::size_t> minutes_of(const std::string& time) {
  // minutes, minutes:seconds, hours:minutes:seconds, days-hours, days-hours:minutes, days-hours:minutes:seconds
  static const std::regex form("(?:([0-9]{1,5})-)?([0-9]{1,9})(?::([0-9]{1,9}))?(?::([0-9]{1,9}))?");
  std::smatch part;
  if (!std::regex_match(time, part, form)) return std::nullopt;
  const auto number = [&](std::size_t k) { return part[k].matched ? std::stoul(part[k]) : 0; };
  if (part[1].matched) return number(1) * 1440 + number(2) * 60 + number(3) + (number(4) + 59) / 60;
  if (part[4].matched) return number(2) * 60 + number(3) + (number(4) + 59) / 60;
  return number(2) + (number(3) + 59) / 60;
}

/// Throws InputError for what Slurm would refuse, or for a warning that takes the whole time.
void check(const SlurmJobs& jobs) {
  static const std::set<std::string> without_end = {"", "0", "infinite", "INFINITE", "unlimited", "UNLIMITED"};
  if (!jobs.memory.empty() && !std::regex_match(jobs.memory, std::regex("[0-9]+[KMGTkmgt]?")))
    throw InputError("--slurm mem: '" + jobs.memory + "' is no memory; it takes a number of megabytes, or 2G");
  if (without_end.contains(jobs.time)) return;
  const auto minutes = minutes_of(jobs.time);
  if (!minutes || *minutes == 0) {
    throw InputError("--slurm time: '" + jobs.time +
                     "' is no time limit; it takes minutes, hours:minutes:seconds or days-hours, as in 2:00:00");
  }
  if (jobs.warning >= 60 * *minutes) {
    throw InputError(fmt::format("--slurm warning: {} s before the end is all of time={}; take fewer, or more time",
                                 jobs.warning, jobs.time));
  }
}

/// A line "#SBATCH --NAME=VALUE"; nothing without a value.
std::string directive(const std::string& name, const std::string& value) {
  return value.empty() ? "" : fmt::format("#SBATCH --{}={}\n", name, shell_word(value));
}

/// Directives that the array and the merge share.
std::string shared(const SlurmJobs& jobs, const fs::path& scripts, const std::string& job, const std::string& log) {
  std::string text = "#!/bin/bash\n" + directive("job-name", job) + directive("chdir", fs::current_path().string()) +
                     directive("output", (scripts / log).string()) + directive("time", jobs.time) +
                     directive("mem", jobs.memory) + directive("account", jobs.account) +
                     directive("partition", jobs.partition);
  for (const std::string& option : jobs.options) text += "#SBATCH " + option + "\n";
  return text;
}

void write_script(const fs::path& path, const std::string& text) {
  write_text(path, text);
  fs::permissions(path, fs::perms::owner_exec | fs::perms::group_exec, fs::perm_options::add);
}

}  // namespace

SlurmJobs read_slurm_jobs(const std::string& text, std::size_t runs) {
  SlurmJobs jobs;
  const std::map<std::string_view, std::function<void(const std::string&, const std::string&)>> keys = {
      {"shards", [&](auto& value, auto& label) { jobs.shards = whole_number(value, label); }},
      {"cpus", [&](auto& value, auto& label) { jobs.cpus = whole_number(value, label); }},
      {"warning", [&](auto& value, auto& label) { jobs.warning = whole_number(value, label); }},
      {"rounds", [&](auto& value, auto& label) { jobs.rounds = whole_number(value, label); }},
      {"time", [&](auto& value, auto&) { jobs.time = value; }},
      {"mem", [&](auto& value, auto&) { jobs.memory = value; }},
      {"account", [&](auto& value, auto&) { jobs.account = value; }},
      {"partition", [&](auto& value, auto&) { jobs.partition = value; }},
      {"option", [&](auto& value, auto&) { jobs.options.push_back(value); }}};
  std::set<std::string> given;
  for (const auto& [key, value] : assignments(text, "--slurm")) {
    const auto known = keys.find(key);
    if (!given.insert(key).second && key != "option") throw InputError("--slurm " + key + ": it is given twice");
    if (known == keys.end()) {
      std::vector<std::string_view> names;
      for (const auto& entry : keys) names.push_back(entry.first);
      throw InputError("--slurm " + key + ": no such key" + suggestion(key, "There are", names));
    }
    known->second(value, "--slurm " + key);
  }
  check(jobs);
  const std::size_t most = largest_index();
  if (jobs.shards > most) {
    throw InputError(
        fmt::format("--slurm shards: {} are more than the {} that the site's MaxArraySize allows; a shard "
                    "carries out many runs",
                    jobs.shards, most));
  }
  if (jobs.shards == 0) jobs.shards = std::min(usual_shards, most);
  jobs.shards = std::clamp<std::size_t>(jobs.shards, 1, std::max<std::size_t>(runs, 1));
  return jobs;
}

void write_job_scripts(const SlurmJobs& jobs, const std::string& experiment, const std::vector<std::string>& words,
                       const fs::path& results) {
  const fs::path out = fs::absolute(results), scripts = out / "slurm";
  fs::create_directories(scripts);
  std::string command = shell_word(fs::read_symlink("/proc/self/exe").string()), of_shard = command;
  for (std::size_t i = 0; i < words.size(); ++i) {
    command += " " + shell_word(words[i]);
    if (words[i] == "--jobs") command += " " + shell_word(words[++i]);  // a shard has as many jobs as cores
    else if (!words[i].starts_with("--jobs=")) of_shard += " " + shell_word(words[i]);
  }

  // With exec the program itself, not a shell, gets the warning before the time limit.
  write_script(scripts / "array.sh",
               shared(jobs, scripts, "polhode-" + experiment, "array-%a.log") +
                   fmt::format("#SBATCH --array=1-{}\n#SBATCH --cpus-per-task={}\n#SBATCH --signal=B:USR1@{}\n"
                               "#SBATCH --open-mode=append\n#SBATCH --requeue\n"
                               "exec {} --shard \"$SLURM_ARRAY_TASK_ID/{}\" --jobs {}\n",
                               jobs.shards, jobs.cpus, jobs.warning, of_shard, jobs.shards, jobs.cpus));
  write_script(scripts / "merge.sh",
               shared(jobs, scripts, "polhode-" + experiment + "-merge", "merge.log") +
                   fmt::format("#SBATCH --open-mode=append\n{} --merge\nstatus=$?\n"
                               "# 75: runs are missing. The array is submitted again, {} times in all at most.\n"
                               "if [ $status = 75 ] && [ \"${{POLHODE_ROUND:-1}}\" -lt {} ]; then\n"
                               "  exec {} $((${{POLHODE_ROUND:-1}} + 1))\nfi\nexit $status\n",
                               command, jobs.rounds, jobs.rounds, shell_word((scripts / "submit.sh").string())));
  write_script(scripts / "submit.sh",
               fmt::format("#!/bin/bash\n# Submits the study to Slurm: the array of its shards, then the merge.\n"
                           "#   submit.sh [ROUND]\nset -eu\ncd {}\narray=$(sbatch --parsable array.sh)\n"
                           "merge=$(sbatch --parsable --dependency=\"afterany:${{array%%;*}}\" "
                           "--export=ALL,POLHODE_ROUND=\"${{1:-1}}\" merge.sh)\n"
                           "echo \"submitted: array $array, merge $merge\"\n",
                           shell_word(scripts.string())));
  write_script(
      scripts / "parallel.sh",
      fmt::format("#!/bin/bash\n# Carries out the study by GNU parallel, here or on hosts that share this "
                  "folder.\n# A host carries out one shard at a time, on as many cores as cpus= of --slurm says.\n"
                  "#   parallel.sh [FILE WITH A HOST A LINE]\nset -u\n"
                  "command -v parallel > /dev/null || {{ echo \"$0: there is no GNU parallel\" >&2; exit 127; }}\n"
                  "hosts=${{1:+$(realpath -- \"$1\")}}\ncd {}\n"
                  "seq {} | parallel --jobs 1 ${{hosts:+--sshloginfile \"$hosts\"}} --workdir {} {} --shard "
                  "'{{}}/{}' --jobs {}\nexec {} --merge\n",
                  shell_word(fs::current_path().string()), jobs.shards, shell_word(fs::current_path().string()),
                  shell_word(of_shard), jobs.shards, jobs.cpus, command));
}

std::string submit_jobs(const fs::path& results) {
  auto submitted = ChildProcess::start({"bash", "submit.sh"}, results / "slurm", {});
  if (!submitted) throw std::runtime_error("there is no bash to submit the jobs");
  const auto outcome = submitted->wait();
  if (outcome.exit_status == 0) return outcome.printed;
  std::string said = outcome.printed;
  std::replace(said.begin(), said.end(), '\n', ' ');
  throw std::runtime_error("the jobs were not submitted: " + said);
}

}  // namespace polhode::study
