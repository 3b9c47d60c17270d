// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/article/pdflatex.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "experiments/study/text/child_process.hpp"
#include "experiments/study/text/notation.hpp"
#include "experiments/study/text/read_file.hpp"

namespace polhode::study::inline report::inline article {
namespace {

constexpr int most_passes = 5;

/// The first error in LaTeX's log with the line that says where: "! Undefined control sequence. l.12 \foo".
std::string first_error(const std::string& log) {
  const auto at = log.rfind("\n! ", log.find("\n! "));
  if (at == std::string::npos) return "no error in its log";
  const auto line = log.find("\nl.", at);
  const auto end = line == std::string::npos ? log.find('\n', at + 1) : log.find('\n', line + 1);
  return one_line(log.substr(at + 1, std::min<std::size_t>(end - at - 1, 400)));
}

}  // namespace

std::string make_pdf(const std::filesystem::path& folder, const std::string& name) {
  const auto run = [&](const std::string& program, const std::vector<std::string>& options) {
    std::vector<std::string> command = {program};
    command.insert(command.end(), options.begin(), options.end());
    auto child = ChildProcess::start(
        command, folder, {{"SOURCE_DATE_EPOCH", "0"}, {"FORCE_SOURCE_DATE", "1"}, {"max_print_line", "1000"}});
    return child ? std::optional(child->wait()) : std::nullopt;
  };
  std::string log;
  for (int pass = 0; pass < most_passes; ++pass) {
    const auto outcome =
        run("pdflatex", {"-interaction=nonstopmode", "-halt-on-error", "-no-shell-escape", name + ".tex"});
    if (!outcome)
      return fmt::format(
          "pdflatex is not installed: {0} has the article's sources, but no PDF. Install it (Debian: apt-get install "
          "texlive-latex-recommended texlive-pictures lmodern) and repeat the command, or take the folder to where "
          "LaTeX is",
          folder.string());
    log = read_file(folder / (name + ".log")).value_or("");
    if (outcome->exit_status != 0)
      throw std::runtime_error(
          fmt::format("pdflatex failed on {}: {}", (folder / (name + ".tex")).string(), first_error(log)));
    if (pass == 0 && read_file(folder / (name + ".aux")).value_or("").find("\\citation{") != std::string::npos)
      run("bibtex", {name});
    else if (pass > 0 && log.find("Rerun") == std::string::npos &&
             log.find("rerunfilecheck Warning") == std::string::npos)
      break;
  }
  return {};
}

}  // namespace polhode::study::report::article
