// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/article/method_section.hpp"

#include <fmt/format.h>

#include "experiments/study/plot/latex_table.hpp"
#include "experiments/study/text/notation.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study::inline report::inline article {
namespace {

std::string properties(const Declaration& d) {
  std::vector<std::string> all;
  all.push_back(d.order > 0 ? fmt::format("of order {}", d.order) : "of variable order");
  if (d.free_order == Declaration::exact_order) all.push_back("exact for free bodies");
  else if (d.free_order > 0 && d.free_order != d.order)
    all.push_back(fmt::format("of order {} for free bodies", d.free_order));
  all.push_back(d.adaptive ? "with steps chosen to a tolerance" : "with a fixed step");
  if (d.implicit) all.push_back("implicit");
  if (d.symmetric) all.push_back("symmetric");
  if (d.symplectic) all.push_back("symplectic");
  std::vector<std::string> conserved;
  if (d.conserves_energy) conserved.push_back("energy");
  if (d.conserves_momentum) conserved.push_back("angular momentum");
  if (d.conserves_casimir) conserved.push_back("the length of the angular momentum in body axes");
  std::string text = fmt::format("It is {}.", words(all));
  if (d.solves_joints()) text += " It solves the equations of joints itself.";
  if (!conserved.empty()) text += fmt::format(" For free bodies it conserves {}.", words(conserved));
  return text;
}

}  // namespace

std::string methods_in_latex(const std::vector<std::string>& methods, Prose& prose) {
  std::string out;
  for (const std::string& name : methods) {
    out += fmt::format("\\paragraph{{\\name{{{}}}}}", tex_breakable(name));
    const IntegratorEntry* entry = find_integrator(name);
    if (entry == nullptr) {
      out += " It is not in the catalogue of methods.\n\n";
      continue;
    }
    const Declaration& d = entry->declaration;
    out += fmt::format(" {} ({}). {}", prose("Method", d.family),
                       d.sources.empty() ? "no source" : fmt::format("\\cite{{{}}}", fmt::join(d.sources, ",")),
                       prose("Method", properties(d)));
    if (d.equation.empty()) out += " " + prose("Method", d.summary);
    else out += fmt::format("\n\\[\\fitted{{\\begin{{aligned}}\n{}\n\\end{{aligned}}}}\\]", d.equation);
    out += "\n\n";
  }
  return out;
}

}  // namespace polhode::study::report::article
