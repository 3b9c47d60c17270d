// SPDX-License-Identifier: BSD-3-Clause
#include "tests/benchmarks/peers/fcl_trees.hpp"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree_array.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/narrowphase/collision_object.h>

namespace polhode::peers {
namespace {

template <class Manager>
class Tree final : public FclTree {
 public:
  explicit Tree(const std::vector<double>& halves) {
    for (std::size_t i = 0; i + 2 < halves.size(); i += 3) {
      const auto box = std::make_shared<fcl::Boxd>(2 * halves[i], 2 * halves[i + 1], 2 * halves[i + 2]);
      objects_.push_back(std::make_unique<fcl::CollisionObjectd>(box));
    }
  }

  std::size_t step(const std::vector<double>& centres) override {
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      objects_[i]->setTranslation({centres[3 * i], centres[3 * i + 1], centres[3 * i + 2]});
      objects_[i]->computeAABB();
    }
    if (manager_.size() == 0) {
      // All at once: one by one, the tree in an array reads its nodes after it has moved them.
      std::vector<fcl::CollisionObjectd*> all;
      for (const auto& object : objects_) all.push_back(object.get());
      manager_.registerObjects(all);
      manager_.setup();
    } else {
      manager_.update();
    }
    std::size_t pairs = 0;
    manager_.collide(&pairs, [](fcl::CollisionObjectd*, fcl::CollisionObjectd*, void* data) {
      ++*static_cast<std::size_t*>(data);
      return false;
    });
    return pairs;
  }

 private:
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects_;
  Manager manager_;
};

}  // namespace

std::unique_ptr<FclTree> fcl_tree(const std::vector<double>& halves, bool in_array) {
  if (in_array) return std::make_unique<Tree<fcl::DynamicAABBTreeCollisionManager_Array<double>>>(halves);
  return std::make_unique<Tree<fcl::DynamicAABBTreeCollisionManager<double>>>(halves);
}

}  // namespace polhode::peers
