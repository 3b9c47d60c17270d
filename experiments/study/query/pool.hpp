// SPDX-License-Identifier: BSD-3-Clause
// Objects that are costly to make, such as connections to a store: each serves one thread at a time and is kept for the
// next one.
#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace polhode::study::inline query {

template <class T>
class Pool {
 public:
  struct PutBack {
    Pool* pool;
    void operator()(T* object) const {
      const std::lock_guard lock(pool->mutex_);
      pool->idle_.emplace_back(object);
    }
  };

  /// An object of its own for the caller, which comes back once the pointer is gone. make() gives a new one, as a
  /// std::unique_ptr, if all others are in use.
  template <class Make>
  std::unique_ptr<T, PutBack> take(const Make& make) {
    std::unique_ptr<T> object;
    {
      const std::lock_guard lock(mutex_);
      if (!idle_.empty()) {
        object = std::move(idle_.back());
        idle_.pop_back();
      }
    }
    if (!object) object = make();
    return {object.release(), PutBack{this}};
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<T>> idle_;
};

}  // namespace polhode::study::query
