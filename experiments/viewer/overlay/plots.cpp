// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/overlay/plots.hpp"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "experiments/study/plot/method_style.hpp"

namespace polhode::viewer::inline overlay {
namespace {

/// The colour of each run: that of its method in the figures of a study; further runs of a method are paler.
std::vector<ImU32> colours_of(const Stage& stage) {
  std::vector<std::string> methods;
  for (std::size_t k = 0; k < stage.views().size(); ++k) {
    const View& view = *stage.views()[k];
    methods.push_back(stage.live() ? view.configuration.run.integrator : stage.title(k, view));
  }
  const std::vector<study::MethodStyle> styles = study::styles_of(methods);
  std::vector<ImU32> colours;
  for (std::size_t k = 0; k < methods.size(); ++k) {
    const auto met = std::count(methods.begin(), methods.begin() + std::ptrdiff_t(k), methods[k]);
    const unsigned long rgb = std::stoul(study::html_colour(styles[k]).substr(1), nullptr, 16);
    const auto part = [&](int shift) {
      const double x = double((rgb >> shift) & 0xFF);
      return int(x + (235 - x) * (1 - std::pow(0.6, double(met))));
    };
    colours.push_back(IM_COL32(part(16), part(8), part(0), 255));
  }
  return colours;
}

/// The present answer of the runs: "energy drift so far: least with rk4, dt = 0.01 s (1e-9 J), most with …".
std::string answer_of(const Stage& stage) {
  std::vector<std::pair<double, std::string>> drifts;
  for (std::size_t k = 0; k < stage.views().size(); ++k) {
    double most = 0;
    for (const PlotPoint& p : stage.views()[k]->plot) most = std::max(most, std::abs(p.energy_drift));
    if (std::isfinite(most)) drifts.emplace_back(most, stage.title(k, *stage.views()[k]));
  }
  if (drifts.size() < 2) return {};
  const auto [least, most] = std::minmax_element(drifts.begin(), drifts.end());
  return fmt::format("energy drift so far: least with {} ({:.2g} J), most with {} ({:.2g} J)", least->second,
                     least->first, most->second, most->first);
}

constexpr ImU32 ink = IM_COL32(38, 44, 52, 255), pale = IM_COL32(200, 206, 214, 255);

struct Quantity {
  const char* title;
  double (*of)(const PlotPoint&);
  double PlotPoint::*further = nullptr;  ///< a second curve, thin
};

constexpr std::array<Quantity, 4> quantities = {{
    {"energy: kinetic, thin: potential / J", [](const PlotPoint& p) { return p.kinetic; }, &PlotPoint::potential},
    {"energy drift / J", [](const PlotPoint& p) { return p.energy_drift; }},
    {"angular momentum drift / (kg m²/s)", [](const PlotPoint& p) { return p.momentum_drift; }},
    {"orientation defect", [](const PlotPoint& p) { return p.defect; }},
}};

struct Range {
  double low = INFINITY, high = -INFINITY;
  void hold(double x) {
    if (!std::isfinite(x)) return;
    low = std::min(low, x);
    high = std::max(high, x);
  }
  bool empty() const { return !(low <= high); }
  /// The range is never empty, so that a constant is a line in the middle.
  void widen() {
    const double least = std::max(std::abs(low), std::abs(high)) * 1e-12;
    if (high - low > least) return;
    const double by = high == 0 ? 1 : std::abs(high) * 0.5;
    low -= by;
    high += by;
  }
};

void plot(Stage& stage, const std::vector<ImU32>& colours, const Quantity& quantity, ImVec2 from, ImVec2 to) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  Range values, times;
  for (const auto& view : stage.views()) {
    for (const PlotPoint& p : view->plot) {
      times.hold(p.t);
      values.hold(quantity.of(p));
      if (quantity.further) values.hold(p.*quantity.further);
    }
    times.hold(view->frame.t);
  }
  list->AddText({from.x, from.y}, ink, quantity.title);
  const float line = ImGui::GetTextLineHeight(), upper = from.y + line + 3, lower = to.y - line - 2;
  list->AddRect({from.x, upper}, {to.x, lower}, pale);
  if (values.empty() || times.empty()) return;
  values.widen();
  times.widen();
  const auto place = [&](double t, double x) {
    return ImVec2(from.x + float((t - times.low) / (times.high - times.low)) * (to.x - from.x),
                  lower - 2 - float((x - values.low) / (values.high - values.low)) * (lower - upper - 4));
  };
  if (values.low < 0 && values.high > 0) list->AddLine(place(times.low, 0), place(times.high, 0), pale);
  std::vector<ImVec2> curve;
  const auto draw = [&](const View& view, auto of, ImU32 colour, float thick) {
    curve.clear();
    for (const PlotPoint& p : view.plot) {
      if (const double x = of(p); std::isfinite(x)) curve.push_back(place(p.t, x));
    }
    for (std::size_t i = 1; i < curve.size(); ++i)
      list->AddLine(curve[i - 1], curve[i], colour, thick);  // segments, without mitres
  };
  for (std::size_t k = 0; k < stage.size(); ++k) {
    const View& view = *stage.views()[k];
    const ImU32 colour = colours[k];
    if (quantity.further)
      draw(
          view, [&](const PlotPoint& p) { return p.*quantity.further; }, colour, 1);
    draw(view, quantity.of, colour, 2);
    const float x = place(view.frame.t, values.low).x;
    list->AddLine({x, upper}, {x, lower}, colour, 1);
  }
  const std::string high = fmt::format("{:.3g}", values.high), low = fmt::format("{:.3g}", values.low);
  list->AddText({from.x + 4, upper + 1}, ink, high.c_str());
  list->AddText({from.x + 4, lower - line - 1}, ink, low.c_str());
  const std::string last = fmt::format("{:.3g} s", times.high);
  list->AddText({from.x, lower + 1}, ink, fmt::format("{:.3g}", times.low).c_str());
  list->AddText({to.x - ImGui::CalcTextSize(last.c_str()).x, lower + 1}, ink, last.c_str());
}

}  // namespace

void draw_plots(Stage& stage, float left, float upper, float width, float height) {
  ImGui::SetNextWindowPos({left, upper});
  ImGui::SetNextWindowSize({width, height});
  ImGui::Begin("plots", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoBringToFrontOnFocus);
  const float row = ImGui::GetTextLineHeight() + 4, margin = 12;
  const float legend = stage.size() > 1 ? 2 * row : 0;  // height of the legend and of the answer below it
  const float each = (width - margin * float(quantities.size() + 1)) / float(quantities.size());
  const std::vector<ImU32> colours = colours_of(stage);
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const float x = left + margin + float(i) * (each + margin);
    plot(stage, colours, quantities[i], {x, upper + 6}, {x + each, upper + height - 6 - legend});
  }
  float x = left + margin;
  for (std::size_t k = 0; k < stage.size() && legend > 0; ++k) {
    const std::string text = stage.title(k, *stage.views()[k]);
    const float y = upper + height - legend - 2;
    ImGui::GetWindowDrawList()->AddLine({x, y + 8}, {x + 20, y + 8}, colours[k], 3);
    ImGui::GetWindowDrawList()->AddText({x + 26, y}, ink, text.c_str());
    x += 46 + ImGui::CalcTextSize(text.c_str()).x;
  }
  if (legend > 0) {
    const std::string text = answer_of(stage);
    ImGui::GetWindowDrawList()->AddText({left + margin, upper + height - row - 2}, ink, text.c_str());
  }
  ImGui::End();
}

}  // namespace polhode::viewer::overlay
