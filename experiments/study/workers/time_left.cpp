// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/workers/time_left.hpp"

#include <algorithm>

namespace polhode::study::inline workers {
namespace {

/// Smallest share of work under way from which a rate is estimated.
constexpr double telling_share = 0.01;

}  // namespace

double TimeLeft::Rates::of(const std::string& kind) const {
  const auto found = known.find(kind);
  return found == known.end() ? others : found->second;
}

void TimeLeft::add(const std::string& kind, double work) { kinds_[kind].work += work; }

void TimeLeft::done(const std::string& kind, double work, double seconds) {
  Kind& all = kinds_[kind];
  all.done += work;
  all.seconds += seconds;
}

std::optional<TimeLeft::Rates> TimeLeft::rates(std::span<const UnderWay> under_way) const {
  Rates rates;
  double work = 0, seconds = 0;
  const auto know = [&](const std::string& kind, double its_work, double its_seconds) {
    if (!(its_work > 0)) return;
    rates.known[kind] = its_seconds / its_work;
    work += its_work;
    seconds += its_seconds;
  };
  std::map<std::string, Kind> begun;
  for (const UnderWay& run : under_way) {
    if (run.share < telling_share) continue;
    begun[run.kind].done += run.work * run.share;
    begun[run.kind].seconds += run.seconds;
  }
  for (const auto& [kind, all] : kinds_) {
    const auto found = begun.find(kind);
    const Kind none;
    const Kind& also = found == begun.end() ? none : found->second;
    know(kind, all.done + also.done, all.seconds + also.seconds);
  }
  if (!(work > 0)) return std::nullopt;
  rates.others = seconds / work;
  return rates;
}

std::optional<double> TimeLeft::seconds(std::span<const UnderWay> under_way, std::size_t workers) const {
  const auto known = rates(under_way);
  if (!known) return std::nullopt;
  double left = 0, longest = 0;
  for (const auto& [kind, all] : kinds_) left += std::max(all.work - all.done, 0.0) * known->of(kind);
  for (const UnderWay& run : under_way) {
    left -= run.work * run.share * known->of(run.kind);
    longest = std::max(longest, run.work * (1 - run.share) * known->of(run.kind));
  }
  return std::max({left / static_cast<double>(std::max<std::size_t>(workers, 1)), longest, 0.0});
}

double TimeLeft::share(std::span<const UnderWay> under_way) const {
  const auto known = rates(under_way);
  if (!known) return 0;
  double all_seconds = 0, done_seconds = 0;
  for (const auto& [kind, all] : kinds_) {
    all_seconds += all.work * known->of(kind);
    done_seconds += all.done * known->of(kind);
  }
  for (const UnderWay& run : under_way) done_seconds += run.work * run.share * known->of(run.kind);
  return all_seconds > 0 ? std::min(done_seconds / all_seconds, 1.0) : 1;
}

}  // namespace polhode::study::workers
