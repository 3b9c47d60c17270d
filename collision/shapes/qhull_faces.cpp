// SPDX-License-Identifier: BSD-3-Clause
#include "collision/shapes/qhull_faces.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace polhode::inline collision::inline shapes {

namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

/// qhull's workspace, with its messages in a file that goes away.
struct Workspace {
  qhT state{};
  std::unique_ptr<std::FILE, Close> messages{std::tmpfile()};

  Workspace() {
    if (!messages) throw std::runtime_error("cannot open a temporary file for qhull's messages");
    qh_zero(&state, messages.get());
  }
  ~Workspace() {
    qh_freeqhull(&state, qh_ALL);
    int memory = 0, blocks = 0;
    qh_memfreeshort(&state, &memory, &blocks);
  }
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;
};

}  // namespace

std::vector<std::vector<std::uint32_t>> qhull_faces(std::span<const Vector3<double>> points, bool triangulated) {
  std::vector<double> coordinates;
  for (const Vector3<double>& p : points) coordinates.insert(coordinates.end(), p.begin(), p.end());
  Workspace workspace;
  qhT* const qh = &workspace.state;
  std::string command = triangulated ? "qhull Qt" : "qhull";
  const int code = qh_new_qhull(qh, 3, int(points.size()), coordinates.data(), False, command.data(), nullptr,
                                workspace.messages.get());
  if (code != 0)
    throw std::invalid_argument("qhull finds no hull of these points (its code " + std::to_string(code) + ")");

  std::vector<std::vector<std::uint32_t>> loops;
  for (facetT* facet = qh->facet_list; facet && facet->next; facet = facet->next) {
    std::vector<std::uint32_t> loop;
    setT* vertices = qh_facet3vertex(qh, facet);
    vertexT *vertex = nullptr, **vertexp = nullptr;
    FOREACHvertex_(vertices) loop.push_back(std::uint32_t(qh_pointid(qh, vertex->point)));
    qh_settempfree(qh, &vertices);
    Vector3<double> turn = Vector3<double>::Zero();
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
      turn += (points[loop[i]] - points[loop[0]]).cross(points[loop[i + 1]] - points[loop[0]]);
    }
    if (turn.dot(Vector3<double>(facet->normal[0], facet->normal[1], facet->normal[2])) < 0) {
      std::reverse(loop.begin(), loop.end());
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace polhode::collision::shapes
