// A run's mesh as flat shapes on paper: what picture.svg draws.
#pragma once

#include "sim/pictures/surface.h"

#include <functional>

namespace hopmesh::pictures {

/// Where a point stands on the paper: pixels from the left and from the top, and how near it is.
struct Seen {
  double x = 0, y = 0, nearness = 0;
};

/// Three points are a face, two a line, one a dot.
struct Shape {
  std::vector<Seen> point;
  std::uint32_t colour = 0; ///< 0xrrggbb
  double size = 0;          ///< width of a line, radius of a dot

  double nearness() const;
};

/// A mesh that lies in a plane before the viewer is seen from straight ahead, any other a little from the
/// side and from above. Shapes are handed out one by one and not kept: a mesh may have millions.
class MeshShapes {
 public:
  using Draw = std::function<void(const Shape&)>;

  explicit MeshShapes(const RunView& view);

  double width() const { return width_; }
  double height() const { return height_; }

  /// Outlines of the mesh as it was; nothing where it has not moved.
  void start(const Draw& draw) const;
  /// The mesh as it came to lie: faces; springs where there are none, or between pinned nodes; pinned nodes.
  void end(const Draw& draw) const;

 private:
  void look();
  Seen seen(const Floats& frame, std::size_t node) const;
  Seen on_paper(const Floats& frame, std::size_t node) const;
  void faces(const Floats& frame, const Draw& draw) const;
  void lines(const Floats& frame, const Draw& draw) const;
  void dots(const Draw& draw) const;

  const RunView& view_;
  const Floats start_, end_; ///< of each node: y is up, z comes towards the viewer
  std::vector<bool> on_face_;
  bool solid_ = false; ///< a skin without a rim, its fronts outside: backs cannot be seen
  bool flat_ = false;
  double width_ = 0, height_ = 0, scale_ = 1;
  Seen middle_;
};

} // namespace hopmesh::pictures
