// A fine mesh as a coarse one, for pictures in which its faces would be smaller than a pixel.
#pragma once

#include "sim/pictures/run_view.h"

namespace hopmesh::pictures {

/// The first and the last frame of a mesh whose nodes are merged: where a node comes to lie in the end
/// decides in which cube it is, and all nodes of a cube become one in their middle. The mesh is `cubes` of
/// them long. Faces and springs within a cube are gone, and of several between the same cubes one is left.
RunView coarse_view(const RunView& view, double cubes);

/// A view whose mesh is merged so in all its frames; what else the view tells stays.
RunView light_view(const RunView& view, double cubes);

} // namespace hopmesh::pictures
