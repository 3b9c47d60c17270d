// SPDX-License-Identifier: BSD-3-Clause
// Something of each step, thinned evenly to a bounded number: when all places are taken, every second one goes.
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

  /// Whether add() would keep something of this step, which must come after all that is kept.
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

}  // namespace polhode::viewer
