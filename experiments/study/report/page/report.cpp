// SPDX-License-Identifier: BSD-3-Clause
// report.html of a study: a self-contained page with the findings first, then the figures, then the runs.
#include "experiments/study/report/page/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <regex>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "experiments/study/plot/gnuplot_figure.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/report/answer/answer.hpp"
#include "experiments/study/report/drawing/scenario_drawing.hpp"
#include "experiments/study/report/drawing/scenario_words.hpp"
#include "experiments/study/report/figures/study_figures.hpp"
#include "experiments/study/report/findings/findings.hpp"
#include "experiments/study/report/findings/method_table.hpp"
#include "experiments/study/report/page/compact_svg.hpp"
#include "experiments/study/report/page/how_to_read.hpp"
#include "experiments/study/report/page/page_style.hpp"
#include "experiments/study/report/page/replay_link.hpp"
#include "experiments/study/report/tables/run_table.hpp"
#include "experiments/study/text/build_info.hpp"
#include "experiments/study/text/notation.hpp"
#include "experiments/study/text/read_file.hpp"
#include "experiments/study/text/text_file.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study::inline report::inline page {

namespace {

constexpr std::size_t open_rows = 40;  // largest number of rows of a table that is shown unfolded
constexpr std::size_t open_rows_of_analysis = 60;
constexpr std::size_t most_open_rows_in_text = 12;
constexpr std::size_t most_runs_shown = 400;  // largest number of runs on the page; runs.csv contains all
constexpr std::size_t most_curves_shown = 300;

/// Title of the page from the name of the experiment: "energy_drift" → "Energy drift".
std::string title_of(const StudyView& study) {
  std::string title = study.experiment;
  std::replace(title.begin(), title.end(), '_', ' ');
  if (!title.empty() && title.front() >= 'a' && title.front() <= 'z')
    title.front() = static_cast<char>(title.front() - 'a' + 'A');
  return title;
}

/// A sentence in which no line breaks within a number like 2e-7 or 20 %.
std::string prose(std::string_view text) {
  static const std::regex number("[0-9.]+(e-[0-9]+| %)");
  return std::regex_replace(html(text), number, "<span class=\"nowrap\">$&</span>");
}

std::string paragraph(std::string_view text) { return fmt::format("<p>{}</p>\n", prose(text)); }

std::string list(const std::vector<std::string>& items) {
  std::string out = "<ul>\n";
  for (const auto& item : items) out += fmt::format("<li>{}</li>\n", prose(item));
  return out + "</ul>\n";
}

std::string folded(const std::string& summary, const std::string& content, bool open) {
  return fmt::format("<details{}>\n<summary>{}</summary>\n{}</details>\n", open ? " open" : "", html(summary), content);
}

bool alone(const StudyView& study) { return study.analysis && study.analysis->alone; }
bool has_answer(const StudyView& study) { return !study.analysis || !study.analysis->answer.sentences.empty(); }

std::string command_html(const StudyView& study) {
  return fmt::format("<h3>The command that makes this again</h3>\n<pre><code>{}</code></pre>\n", html(study.command));
}

/// Head of the page; contents: links of the table of contents.
std::string head(const StudyView& study, std::string_view contents) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{} – "
      "polhode</title>\n<style>{}</style>\n"
      "</head>\n<body>\n<header>\n<h1>{}</h1>\n<p class=\"question\">{}</p>\n"
      "<nav aria-label=\"Contents\"><ul>{}<li><a href=\"#seen\">What is "
      "seen</a></li>{}</ul></nav>\n</header>\n<main>\n",
      html(title_of(study)), page_style, html(title_of(study)), html(study.question),
      std::string(has_answer(study) ? "<li><a href=\"#answer\">The answer</a></li>" : "") +
          (study.scenarios.empty() ? "" : "<li><a href=\"#scenario\">The scenario</a></li>"),
      contents);
}

std::string head(const StudyView& study) {
  constexpr const char* of_curves =
      "<li><a href=\"#figures\">Figures</a></li><li><a href=\"#methods\">Method by method</a></li>";
  constexpr const char* of_runs = "<li><a href=\"#run\">What was run</a></li><li><a href=\"#runs\">All runs</a></li>";
  return head(study, std::string(alone(study) ? "" : of_curves) + of_runs);
}

/// Statements under their heading, and what belongs to them. `below_answer`: many are folded.
std::string statements(const std::string& heading, const std::vector<std::string>& sentences, const std::string& more,
                       bool below_answer) {
  constexpr std::size_t most_open = 3;
  const std::string content = (sentences.empty() ? "" : list(sentences)) + more;
  if (below_answer && sentences.size() > most_open)
    return folded(fmt::format("{}: {}", heading, count(sentences.size(), "statement")), content, false);
  return fmt::format("<h3>{}</h3>\n{}", html(heading), content);
}

/// The analysis of the experiment, which answers its question and therefore comes first.
std::string analysis_html(const Analysis& analysis) {
  std::string out = statements(analysis.heading, analysis.sentences, "", !analysis.answer.sentences.empty());
  for (const auto& [name, table] : analysis.tables) {
    out += table.rows.size() > open_rows_of_analysis ? folded(table.caption, html(table, Caption::spoken), false)
                                                     : html(table);
    out += fmt::format(
        "<p>For a text: <a href=\"tables/{0}.tex\">LaTeX</a>, <a href=\"tables/{0}.md\">Markdown</a>, <a "
        "href=\"tables/{0}.csv\">CSV</a>.</p>\n",
        name);
  }
  for (const auto& sentence : analysis.method) out += paragraph(sentence);
  std::vector<std::string> links;
  for (const auto& file : analysis.files) links.push_back(fmt::format("<a href=\"{0}\">{0}</a>", file.name.string()));
  if (!links.empty()) out += fmt::format("<p>All digits: {}.</p>\n", fmt::join(links, ", "));
  return out;
}

/// The picture of a figure, if it was drawn from the present data; an older one in the folder may show another study.
std::optional<std::string> picture(const StudyView& study, const Figure& figure) {
  const auto file = (study.folder / "figures" / figure.name).string();
  if (read_file(file + ".gp") != gnuplot_script(figure) || read_file(file + ".dat") != gnuplot_data(figure))
    return std::nullopt;
  return read_file(file + ".svg");
}

std::string file_links(const Figure& figure, std::string_view folder = "figures") {
  std::vector<std::string> links;
  for (const auto* kind : {"svg", "pdf", "dat", "gp", "tex"}) {
    links.push_back(fmt::format("<a href=\"{2}/{0}.{1}\">{1}</a>", figure.name, kind, folder));
  }
  return fmt::format("{}", fmt::join(links, ", "));
}

constexpr const char* not_drawn =
    "<p class=\"none\">Not drawn: figures were not asked for, or gnuplot is not installed.</p>";

std::string figure_html(const StudyView& study, const Figure& figure) {
  const auto svg = picture(study, figure);
  const auto drawing = svg ? fmt::format("<div class=\"drawing\"><img alt=\"{}\" src=\"{}\"></div>",
                                         html(figure.title + ". " + figure.caption), svg_address(compact_svg(*svg)))
                           : std::string(not_drawn);
  return fmt::format("<figure id=\"{}\">\n{}\n<figcaption><b>{}.</b> {}{}</figcaption>\n</figure>\n", figure.name,
                     drawing, html(figure.title), html(figure.caption),
                     svg ? fmt::format(" Files: {}.", file_links(figure)) : "");
}

/// A figure of wall times, included by reference: wall times differ from call to call, the bytes of this page must not.
std::string timed_figure(const StudyView& study, const Figure& figure) {
  const bool drawn = std::filesystem::exists(study.folder / timings_folder / (figure.name + ".svg"));
  const auto drawing = drawn ? fmt::format("<div class=\"drawing\"><img alt=\"{}\" src=\"{}/{}.svg\"></div>",
                                           html(figure.title), timings_folder, figure.name)
                             : std::string(not_drawn);
  return fmt::format(
      "<figure id=\"{}\">\n{}\n<figcaption><b>{}.</b> {} Wall times differ from call to call: this picture stays in "
      "its own file, is no part of this page, and is gone where the page is moved alone.{}</figcaption>\n</figure>\n",
      figure.name, drawing, html(figure.title), html(figure.caption),
      drawn ? fmt::format(" Files: {}.", file_links(figure, timings_folder)) : "");
}

/// True for a page whose answer is about costs alone, so that a figure of wall times stands beside it.
bool times_beside_answer(const StudyView& study) {
  return study.runs.empty() && has_answer(study) && !study.analysis->timed.figures.empty();
}

/// The answer's sentences; the first one stands out.
std::string answer_sentences(const std::vector<std::string>& sentences) {
  std::string out;
  for (const std::string& sentence : sentences)
    out += fmt::format("<p class=\"{}\">{}</p>\n", out.empty() ? "answer first" : "answer", prose(sentence));
  return out;
}

/// Name of the figure that stands beside the answer.
std::string figure_beside_answer(const StudyView& study) {
  if (!study.analysis) return figure_of_the_answer;
  if (times_beside_answer(study)) return "";
  return has_answer(study) && !study.analysis->figures.empty() ? study.analysis->figures.front().name : "";
}

/// The first part of the page: the answer, the table and the figure that show it, and its conditions.
std::string answer_html(const StudyView& study, const Grouping& grouping, const FigureSet& set) {
  if (!has_answer(study)) return {};
  std::string out = "<section id=\"answer\">\n<h2 class=\"spoken\">The answer</h2>\n";
  const Answer answer = study.analysis ? study.analysis->answer : answer_of(study, grouping);
  out += answer_sentences(answer.sentences);
  if (answer.table) out += html(*answer.table);
  if (times_beside_answer(study)) out += timed_figure(study, study.analysis->timed.figures.front());
  for (const auto& figure : set.figures) {
    if (figure.name == figure_beside_answer(study)) out += figure_html(study, figure);
  }
  if (!answer.depends.empty()) out += folded("What the answer depends on", list(answer.depends), false);
  return out + "</section>\n";
}

/// A scenario: what it is, how it starts, and its data in words.
std::string scenario_html(const Scenario& scenario) {
  const ScenarioDrawing drawing = drawing_of(scenario);
  std::string out = fmt::format("<h3>{} <code>{}</code></h3>\n", html(scenario.title), html(scenario.name));
  if (!scenario.description.empty()) out += paragraph(scenario.description);
  if (drawing.svg.empty()) return out;
  return out + fmt::format(
                   "<div class=\"start\">\n<figure><div class=\"drawing\">{}</div>\n<figcaption>{}</figcaption>"
                   "</figure>\n{}</div>\n",
                   drawing.svg, html(drawing.reading), list(scenario_words(scenario)));
}

/// The scenarios as they start; many are folded.
std::string scenarios(const StudyView& study) {
  constexpr std::size_t most_open = 2, most_drawn = 20;
  if (study.scenarios.empty()) return {};
  std::string open, more;
  const std::size_t drawn = std::min(study.scenarios.size(), most_drawn);
  for (std::size_t k = 0; k < drawn; ++k) (k < most_open ? open : more) += scenario_html(study.scenarios[k]);
  if (drawn < study.scenarios.size())
    more += paragraph(fmt::format("{} more are not drawn.", count(study.scenarios.size() - drawn, "scenario")));
  std::string out = fmt::format("<section id=\"scenario\">\n<h2>The scenario{} at the start</h2>\n{}",
                                study.scenarios.size() == 1 ? "" : "s", open);
  if (!more.empty()) out += folded(count(study.scenarios.size() - most_open, "more scenario"), more, false);
  if (!study.varied_keys.empty())
    out += paragraph(fmt::format("As the file gives it. The runs vary {}.", words(study.varied_keys)));
  return out + "</section>\n";
}

std::string what_is_seen(const StudyView& study, const Findings& findings) {
  std::string out = fmt::format("<section id=\"seen\">\n<h2>What is seen</h2>\n<p class=\"outcome\">{}</p>\n",
                                html(findings.outcome));
  out += replay_line(study.folder);
  if (alone(study)) return out + analysis_html(*study.analysis) + "</section>\n";
  for (const auto& caution : findings.cautions) {
    out += fmt::format("<div class=\"caution\" role=\"note\"><strong>Caution</strong> {}</div>\n", prose(caution));
  }
  if (study.analysis) out += analysis_html(*study.analysis);
  for (const auto& topic : findings.topics) {
    std::string tables;
    for (const auto& table : topic.tables) {
      tables += table.rows.size() > most_open_rows_in_text ? folded(table.caption, html(table, Caption::spoken), false)
                                                           : html(table);
    }
    out += statements(topic.heading, topic.sentences, tables, has_answer(study));
  }
  return out + "</section>\n";
}

std::string timed_figures(const StudyView& study) {
  std::string out;
  if (!study.analysis) return out;
  const Analysis::Timed& timed = study.analysis->timed;
  for (std::size_t k = times_beside_answer(study) ? 1 : 0; k < timed.figures.size(); ++k)
    out += timed_figure(study, timed.figures[k]);
  std::vector<std::string> links;
  for (const auto& file : timed.files) {
    links.push_back(fmt::format("<a href=\"{0}/{1}\">{0}/{1}</a>", timings_folder, file.name.string()));
  }
  if (!links.empty()) out += fmt::format("<p>From wall times too: {}.</p>\n", fmt::join(links, ", "));
  return out;
}

std::string figures(const StudyView& study, const FigureSet& set) {
  std::string out = "<section id=\"figures\">\n<h2>Figures</h2>\n";
  const std::size_t own = study.analysis ? study.analysis->figures.size() : 0;
  for (std::size_t i = 0; i < set.figures.size(); ++i) {
    if (i == own) out += timed_figures(study);
    if (set.figures[i].name != figure_beside_answer(study)) out += figure_html(study, set.figures[i]);
  }
  if (own >= set.figures.size()) out += timed_figures(study);
  for (const auto& absent : set.absent)
    out += paragraph(fmt::format("There is no figure “{}”: {}.", absent.title, absent.reason));
  return out + "</section>\n";
}

std::string methods(const Grouping& grouping) {
  auto table = method_table(grouping);
  const auto all = table.rows.size();
  if (all > most_curves_shown) table.rows.resize(most_curves_shown);
  std::string out = "<section id=\"methods\">\n<h2>Method by method</h2>\n";
  if (all > open_rows) {
    const auto summary = all > most_curves_shown ? fmt::format("The first {} of {} rows", most_curves_shown, all)
                                                 : fmt::format("{} rows", all);
    out += folded(summary, html(table), false);
  } else {
    out += html(table);
  }
  return out +
         "<p>For a text: <a href=\"tables/methods.tex\">LaTeX</a>, <a href=\"tables/methods.md\">Markdown</a>, <a "
         "href=\"tables/methods.csv\">CSV</a>.</p>\n</section>\n";
}

std::string catalogue_table(const Grouping& grouping) {
  using Kind = Column::Kind;
  Table table{.caption = "The methods",
              .columns = {{"name", "", Kind::name},
                          {"family", "", Kind::text},
                          {"order"},
                          {"step", "", Kind::text},
                          {"what it is", "", Kind::text}},
              .rows = {}};
  for (const auto& name : grouping.methods) {
    const auto* entry = find_integrator(name);
    if (entry == nullptr) {
      table.rows.push_back({name, "", "", "", ""});
      continue;
    }
    const auto& d = entry->declaration;
    table.rows.push_back({name, d.family, d.order > 0 ? std::to_string(d.order) : "variable",
                          d.adaptive ? "chosen to a tolerance" : "fixed",
                          fmt::format("{}{}", summary_of(d), d.implicit ? " (implicit)" : "")});
  }
  return html(table);
}

/// Values in descending order: "0.1, 0.01" or, for many, "20 values from 0.1 to 1e-4".
std::string value_list(const std::set<double, std::greater<>>& values) {
  constexpr std::size_t most = 12;
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(rounded(value));
  if (texts.size() <= most) return fmt::format("{}", fmt::join(texts, ", "));
  return fmt::format("{} values from {} to {}", texts.size(), texts.front(), texts.back());
}

/// Values of an option in the runs of the study.
std::string values_of(const RunOption& option, const StudyView& study) {
  std::set<double, std::greater<>> numbers;
  std::set<std::string> texts;
  for (const auto& run : study.runs) {
    const OptionValue value = option.value(run.config);
    if (const auto* x = std::get_if<double>(&value)) {
      numbers.insert(*x);
    } else if (value != OptionValue{}) {
      // The impact timing of a response that is a force has an empty name, which is left out.
      if (const std::string text = text_of(value); !text.empty() && option.applies_to(run.config)) texts.insert(text);
    } else if (!option.unsaid.empty()) {
      texts.insert(option.unsaid);
    }
  }
  return option.kind == RunOption::Kind::number ? value_list(numbers) : fmt::format("{}", fmt::join(texts, ", "));
}

std::string options_html(const StudyView& study) {
  using Role = RunOption::Role;
  std::string out = fmt::format("<h3>Options{}</h3>\n<dl>\n",
                                study.runs.size() < study.size() ? " of the runs in the table below" : "");
  const auto add = [&](const std::string& term, const std::string& text) {
    if (!text.empty()) out += fmt::format("<dt>{}</dt><dd>{}</dd>\n", term, html(text));
  };
  const auto add_options = [&](Role role, bool numbers) {
    for (const RunOption* option : options_of_role(role)) {
      if ((option->kind == RunOption::Kind::number) != numbers && role != Role::variant) continue;
      add(option->term.empty() ? option->header : option->term, values_of(*option, study));
    }
  };
  add_options(Role::size, true);
  add_options(Role::duration, true);
  for (const auto& key : study.varied_keys) {
    std::set<std::string> values;
    for (const auto& run : study.runs) {
      for (const auto& varied : run.config.varied) {
        if (varied.key == key && !varied.value.empty()) values.insert(rounded(varied.value));
      }
    }
    add(html(key),
        values.size() <= 12 ? fmt::format("{}", fmt::join(values, ", ")) : fmt::format("{} values", values.size()));
  }
  add_options(Role::variant, false);
  add_options(Role::duration, false);
  return out + "</dl>\n";
}

std::string what_was_run(const StudyView& study, const Grouping& grouping) {
  return fmt::format("<section id=\"run\">\n<h2>What was run</h2>\n<h3>Methods</h3>\n{}{}{}</section>\n",
                     catalogue_table(grouping), options_html(study), command_html(study));
}

std::string all_runs(const StudyView& study) {
  const auto n = study.runs.size();
  std::vector<std::size_t> first(std::min(n, most_runs_shown));
  std::iota(first.begin(), first.end(), std::size_t{0});
  auto table = run_table(study, Extent::all, first);
  table.caption = "In the order of runs.csv";
  std::string out =
      "<section id=\"runs\">\n<h2>All runs</h2>\n<p>All digits and all options: <a href=\"runs.csv\">runs.csv</a>; for "
      "a text: "
      "<a href=\"tables/summary.tex\">LaTeX</a>, <a href=\"tables/summary.md\">Markdown</a>, <a "
      "href=\"tables/summary.csv\">CSV</a>, "
      "<a href=\"tables/values.tex\">LaTeX commands</a>; what made them: <a "
      "href=\"manifest.json\">manifest.json</a>.</p>\n";
  std::string summary =
      n > most_runs_shown ? fmt::format("The first {} of {} runs", most_runs_shown, n) : count(n, "run");
  if (n < study.size()) summary += fmt::format(" of evenly chosen motions; the study has {}", study.size());
  return out + folded(summary, html(table), n <= open_rows) + "</section>\n";
}

std::string foot() {
  const auto& build = build_info();
  return fmt::format(
      "</main>\n<footer><p>Made by polhode {}, commit {}. SI units throughout. "
      "<code>./run guide</code> makes the book about methods, figures and columns.</p></footer>\n</body>\n</html>\n",
      html(build.version), html(build.commit));
}

/// Page of an experiment without runs, which contains only its analysis.
std::string report_without_runs(const StudyView& study) {
  const FigureSet set{study.analysis->figures, {}};
  return head(study, "<li><a href=\"#figures\">Figures</a></li>") + answer_html(study, {}, set) +
         "<section id=\"seen\">\n<h2>What is seen</h2>\n" + analysis_html(*study.analysis) + command_html(study) +
         "</section>\n" + figures(study, set) + foot();
}

}  // namespace

void write_report(const StudyView& study) {
  if (study.runs.empty() && study.analysis) {
    write_text(study.folder / "report.html", report_without_runs(study));
    return;
  }
  const auto grouping = group(study);
  if (alone(study)) {
    const std::size_t beside_answer = figure_beside_answer(study).empty() ? 0 : 1;
    const bool drawn = study.analysis->figures.size() > beside_answer || !study.analysis->timed.figures.empty();
    write_text(study.folder / "report.html", head(study) + answer_html(study, grouping, {study.analysis->figures, {}}) +
                                                 scenarios(study) + what_is_seen(study, findings_of(study, grouping)) +
                                                 (drawn ? figures(study, {study.analysis->figures, {}}) : "") +
                                                 what_was_run(study, grouping) + all_runs(study) + foot());
    return;
  }
  const auto set = figures_of(study, grouping);
  write_text(study.folder / "report.html",
             head(study) + answer_html(study, grouping, set) + scenarios(study) + std::string(how_to_read) +
                 what_is_seen(study, findings_of(study, grouping)) + figures(study, set) + methods(grouping) +
                 what_was_run(study, grouping) + all_runs(study) + foot());
}

}  // namespace polhode::study::report::page
