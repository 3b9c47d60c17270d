// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/article/article.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "experiments/study/curves/curves.hpp"
#include "experiments/study/plot/latex_table.hpp"
#include "experiments/study/plot/pgfplots_figure.hpp"
#include "experiments/study/report/answer/answer.hpp"
#include "experiments/study/report/article/method_section.hpp"
#include "experiments/study/report/article/pdflatex.hpp"
#include "experiments/study/report/article/prose.hpp"
#include "experiments/study/report/article/references.hpp"
#include "experiments/study/report/article/scenario_section.hpp"
#include "experiments/study/report/figures/study_figures.hpp"
#include "experiments/study/report/findings/findings.hpp"
#include "experiments/study/report/findings/method_table.hpp"
#include "experiments/study/report/tables/run_table.hpp"
#include "experiments/study/text/build_info.hpp"
#include "experiments/study/text/notation.hpp"
#include "experiments/study/text/read_file.hpp"
#include "experiments/study/text/text_file.hpp"

namespace polhode::study::inline report::inline article {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_rows = 90;         // largest number of rows of a table in the article
constexpr std::size_t most_scenarios = 12;    // largest number of scenarios with tables of their bodies and forces
constexpr std::size_t floats_at_a_time = 16;  // number of floats between two places where all of them are set

constexpr const char* preamble = R"(\documentclass[11pt,a4paper]{article}
\usepackage[utf8]{inputenc}\usepackage[T1]{fontenc}\usepackage{textcomp,lmodern}
\usepackage{amsmath,amssymb,array,booktabs,longtable,pgfplots}
\usepackage[font=small,labelfont=bf,justification=raggedright,singlelinecheck=off]{caption}
\usepgfplotslibrary{groupplots}\pgfplotsset{compat=1.17}
\pdftrailerid{} % the same bytes from call to call
% \name{rk4}: a name as programs and tables write it. \code{...}: a command, a hash. \fitted{...}: a formula that is made
% smaller where it is wider than the line.
\setlength{\parskip}{0.6ex plus 0.3ex}
\newcommand{\name}[1]{\texttt{#1}}
\newcommand{\code}[1]{{\ttfamily\raggedright #1\par}}
\newsavebox{\formula}
\newcommand{\fitted}[1]{\sbox{\formula}{$\displaystyle #1$}%
  \ifdim\wd\formula>\linewidth\resizebox{\linewidth}{!}{\usebox{\formula}}\else\usebox{\formula}\fi}
\input{numbers}
)";

/// "energy_drift" → "Energy drift".
std::string title_of(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  if (!name.empty() && name.front() >= 'a' && name.front() <= 'z') name.front() = static_cast<char>(name.front() - 32);
  return name;
}

/// The day on which the results were stored; of a study without a store, today: "2026-01-31".
std::string date_of(const fs::path& folder) {
  const fs::path store = folder / "results.sqlite";
  std::time_t time = std::time(nullptr);
  if (fs::exists(store)) {
    const auto written = fs::last_write_time(store);
    time = std::chrono::system_clock::to_time_t(std::chrono::file_clock::to_sys(written));
  }
  return fmt::format("{:%Y-%m-%d}", fmt::gmtime(time));
}

class Article {
 public:
  explicit Article(const StudyView& study) : study_(study), folder_(study.folder / article_folder) {
    if (study.runs.empty()) return;
    grouping_ = group(study);
    prose_ = Prose({grouping_->methods.begin(), grouping_->methods.end()});
  }

  std::string write() {
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "figures");
    fs::create_directories(folder_ / "tables");
    section("answer", answer());
    section("results", results());
    section("figures", figures());
    if (!study_.runs.empty()) {
      section("methods", methods());
      section("scenarios", scenarios());
    }
    section("provenance", provenance());
    write_text(folder_ / "numbers.tex",
               "% The numbers of the article as commands, each below the sentence that it stands in.\n" +
                   prose_.definitions());
    for (const Bibliography& b : bibliographies()) write_text(folder_ / (std::string(b.name) + ".bib"), b.text);
    write_text(folder_ / "article.tex", document());
    return make_pdf(folder_, "article");
  }

 private:
  bool alone() const { return study_.analysis && study_.analysis->alone; }

  void section(const std::string& name, const std::string& text) {
    write_text(folder_ / (name + ".tex"), text);
    sections_ += fmt::format("\\input{{{}}}\n", name);
  }

  std::string document() const {
    return fmt::format(
        "{}\\title{{{}}}\n\\author{{Made by polhode \\polhodeVersion}}\n\\date{{Results of "
        "\\polhodeDate}}\n\\begin{{document}}\n"
        "\\maketitle\n\\raggedright % long names would spread the words of a "
        "line\n\\noindent\\emph{{{}}}\n\n{}{}\\end{{document}}\n",
        preamble, title_, question_, sections_,
        cites_ ? "{\\raggedright\\bibliographystyle{plain}\\bibliography{references}}\n" : "");
  }

  std::string paragraphs(const std::string& place, const std::vector<std::string>& sentences) {
    std::string out;
    for (const auto& sentence : sentences) out += prose_(place, sentence) + "\n\n";
    return out;
  }

  std::string list(const std::string& place, const std::vector<std::string>& sentences) {
    if (sentences.empty()) return {};
    std::string out = "\\begin{itemize}\n";
    for (const auto& sentence : sentences) out += fmt::format("\\item {}\n", prose_(place, sentence));
    return out + "\\end{itemize}\n";
  }

  /// All floats so far are set before the text goes on, so that they are not too many.
  std::string float_done() { return ++floats_ % floats_at_a_time == 0 ? "\\clearpage\n" : ""; }

  /// Writes a table, and the lines that include it; a table of many rows is left to the folder tables/.
  std::string table(const std::string& name, const Table& table) {
    if (table.rows.empty()) return {};
    if (table.rows.size() > most_rows)
      return prose_("Table",
                    fmt::format("A table of {} rows is not printed here: tables/{}.csv. ", table.rows.size(), name)) +
             "\n\n";
    const LatexTable made = latex_table(table);
    const std::string best = words_for_best(table);
    write_text(folder_ / "tables" / (name + ".tex"), made.text);
    std::string caption = table.caption + (best.empty() ? "" : ". " + best);
    if (!caption.ends_with('.')) caption += '.';
    caption = prose_("Table", caption);
    if (made.over_pages)
      return fmt::format(
          "\\begin{{center}}\\captionof{{table}}{{{}}}\\end{{center}}\\nopagebreak\n\\input{{tables/{}}}\n", caption,
          name);
    return fmt::format("\\begin{{table}}[!htbp]\n\\caption{{{}}}\n\\input{{tables/{}}}\\end{{table}}\n{}", caption,
                       name, float_done());
  }

  /// Writes a figure, and the lines that include its first page.
  std::string figure(const Figure& figure) {
    const auto pages = pgfplots(figure);
    for (std::size_t p = 0; p < pages.size(); ++p)
      write_text(folder_ / "figures" / pgfplots_file(figure.name, p), pages[p]);
    std::string caption = figure.title + ". " + figure.caption;
    if (pages.size() > 1)
      caption += fmt::format(" Page 1 of {}; the others are in the article's folder {}.", pages.size(), "figures");
    drawn_.push_back(figure.name);
    return fmt::format(
        "\\begin{{figure}}[!htbp]\n\\centering\n\\input{{figures/{}}}\\caption{{{}}}\n\\end{{figure}}\n{}", figure.name,
        prose_("Figure", caption), float_done());
  }

  std::string answer() {
    title_ = prose_("Title", title_of(study_.experiment));
    question_ = prose_("Question", study_.question);
    Answer found;
    if (study_.analysis) found = study_.analysis->answer;
    else if (grouping_) found = answer_of(study_, *grouping_);
    if (found.sentences.empty() && study_.analysis) found.sentences = study_.analysis->sentences;
    std::string out = "\\section{Answer}\n" + paragraphs("Answer", found.sentences);
    if (found.table) out += table("answer", *found.table);
    set_ = alone() || !grouping_ ? FigureSet{study_.analysis ? study_.analysis->figures : std::vector<Figure>{}, {}}
                                 : figures_of(study_, *grouping_);
    const std::string beside = study_.analysis
                                   ? (study_.analysis->figures.empty() ? "" : study_.analysis->figures.front().name)
                                   : figure_of_the_answer;
    for (const auto& f : set_.figures) {
      if (f.name == beside) out += figure(f);
    }
    if (!found.depends.empty()) out += "\\subsection*{What the answer depends on}\n" + list("Depends", found.depends);
    return out;
  }

  std::string results() {
    std::string out = "\\section{Results}\n";
    const Analysis* analysis = study_.analysis ? &*study_.analysis : nullptr;
    if (grouping_) {
      const Findings findings = findings_of(study_, *grouping_);
      out += paragraphs("Outcome", {findings.outcome});
      if (!alone()) out += list("Caution", findings.cautions);
      if (analysis) out += own(*analysis);
      for (const Topic& topic : alone() ? std::vector<Topic>{} : findings.topics) {
        out +=
            fmt::format("\\subsection*{{{}}}\n{}", prose_("Heading", topic.heading), list("Finding", topic.sentences));
        for (const Table& t : topic.tables) out += table(fmt::format("findings_{}", ++topic_tables_), t);
      }
      if (!alone()) {
        Table methods = method_table(*grouping_);
        methods.caption = "Method by method. " + methods.caption;
        out += table("methods", methods);
        std::vector<std::size_t> all(study_.runs.size());
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
        if (all.size() <= most_rows) {
          Table runs = run_table(study_, Extent::summary, all);
          runs.caption = "The runs";
          out += table("summary", runs);
        }
      }
    } else if (analysis) {
      out += own(*analysis);
    }
    return out;
  }

  std::string own(const Analysis& analysis) {
    std::string out;
    if (!analysis.heading.empty()) out += fmt::format("\\subsection*{{{}}}\n", prose_("Heading", analysis.heading));
    out += list("Finding", analysis.answer.sentences.empty() && !analysis.sentences.empty() && !grouping_
                               ? std::vector<std::string>{}
                               : analysis.sentences);
    for (const auto& [name, t] : analysis.tables) out += table(name, t);
    return out + paragraphs("Procedure", analysis.method);
  }

  std::string figures() {
    std::string out;
    for (const auto& f : set_.figures) {
      if (std::find(drawn_.begin(), drawn_.end(), f.name) == drawn_.end()) out += figure(f);
    }
    for (const auto& absent : set_.absent)
      out += prose_("Absent", fmt::format("There is no figure “{}”: {}.", absent.title, absent.reason)) + "\n\n";
    return out + "\\clearpage\n";
  }

  std::string methods() {
    cites_ = true;
    return "\\section{Methods}\n"
           "In the equations $h$ is the step, $y$ the state, $q$ its configuration and $v$ its velocities, $f$ the\n"
           "right-hand side or a force, $\\tau$ a torque, $R$ the rotation matrix from body to world, $I$ the inertia, "
           "$\\Omega$ and\n$m$ angular velocity and momentum in body axes, $L$ the momentum in world axes, $\\hat{\\ "
           "}$ the "
           "matrix of a cross product.\n\n" +
           methods_in_latex(grouping_->methods, prose_);
  }

  std::string scenarios() {
    std::string out = "\\section{Scenarios}\n";
    std::size_t shown = 0;
    for (const Scenario& scenario : study_.scenarios) {
      out += fmt::format("\\subsection*{{\\name{{{}}}: {}}}\n{}\n\n", tex_breakable(scenario.name),
                         prose_("Scenario", scenario.title), prose_("Scenario", scenario.description));
      if (++shown > most_scenarios) continue;
      out += table(fmt::format("bodies_{}", shown), table_of_bodies(scenario));
      const Table forces = table_of_forces(scenario);
      out += forces.rows.empty() ? "No force acts.\n\n" : table(fmt::format("forces_{}", shown), forces);
      if (!scenario.problem.joints.empty()) out += table(fmt::format("joints_{}", shown), table_of_joints(scenario));
      out += fmt::format("\\noindent Hash of the scenario's data: \\code{{{:016x}}}\n", number_of(scenario));
    }
    return out + "\\clearpage\n";
  }

  std::string provenance() {
    using Json = nlohmann::ordered_json;
    const BuildInfo& build = build_info();
    prose_.value("Version", build.version);
    prose_.value("Date", date_of(study_.folder));
    std::string out = "\\section{Provenance}\n\\begin{description}\n";
    const auto item = [&](const char* what, std::string_view value) {
      if (!value.empty()) out += fmt::format("\\item[{}] \\code{{{}}}\n", what, tex_breakable(value));
    };
    item("Command", study_.command);
    item("Program", fmt::format("polhode {}, commit {}", build.version, build.commit));
    item("Compiler", fmt::format("{}, {}", build.compiler, build.flags));
    const Json manifest = Json::parse(read_file(study_.folder / "manifest.json").value_or("{}"), nullptr, false);
    const auto said = [&](const char* key) {
      return manifest.is_object() && manifest.contains(key) && manifest[key].is_string()
                 ? manifest[key].get<std::string>()
                 : "";
    };
    item("Processor", said("processor"));
    item("Operating system", said("operating_system"));
    item("Hash of the study", said("study"));
    if (manifest.is_object() && manifest.contains("libraries")) {
      std::vector<std::string> libraries;
      for (const auto& [name, version] : manifest["libraries"].items())
        libraries.push_back(fmt::format("{} {}", name, version.get<std::string>()));
      item("Libraries", fmt::format("{}", fmt::join(libraries, ", ")));
    }
    return out + "\\end{description}\n";
  }

  const StudyView& study_;
  fs::path folder_;
  std::optional<Grouping> grouping_;
  Prose prose_;
  FigureSet set_;
  std::vector<std::string> drawn_;
  std::string sections_, title_, question_;
  std::size_t floats_ = 0, topic_tables_ = 0;
  bool cites_ = false;
};

}  // namespace

std::string write_article(const StudyView& study) { return Article(study).write(); }

}  // namespace polhode::study::report::article
