// SPDX-License-Identifier: BSD-3-Clause
// Values at steps, thinned evenly to a bounded number: when the capacity is reached, every second value is removed.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace polhode::viewer::inline session {

template <class T>
class Thinned {
 public:
  struct Item {
    std::int64_t step;
    T value;
  };

  explicit Thinned(std::size_t capacity) : capacity_(std::max<std::size_t>(capacity, 2)) {}

  /// True if add() stores a value of this step. Values must be added in ascending order of steps.
  bool wants(std::int64_t step) const { return step % stride_ == 0 && (items_.empty() || items_.back().step < step); }

  void add(std::int64_t step, T value) {
    if (!wants(step)) return;
    if (items_.size() == capacity_) {
      stride_ *= 2;
      std::erase_if(items_, [this](const Item& item) { return item.step % stride_ != 0; });
      if (!wants(step)) return;
    }
    items_.push_back({step, std::move(value)});
  }

  void forget_after(std::int64_t step) {
    while (!items_.empty() && items_.back().step > step) items_.pop_back();
  }

  const std::vector<Item>& items() const { return items_; }

 private:
  std::size_t capacity_;
  std::int64_t stride_ = 1;
  std::vector<Item> items_;
};

}  // namespace polhode::viewer::session
