// Makers of the scenes of hard_cases(). Positions and sizes are short sums of powers of two, and no node rotates.
// Translations by such sums and scales by powers of two are therefore exact.
#pragma once

#include "renderer/scene/scene.h"

namespace si {

// Each function returns the scene of a hard case:

Scene hard_floor_and_box();   ///< a box that floats a little above a floor
Scene hard_sphere();          ///< a fine sphere over a floor
Scene hard_spot_floor();      ///< a floor seen from above, with a box
Scene hard_plate_above();     ///< a thin plate over a floor: no side of it under a light straight above
Scene hard_wall();            ///< a wall on a wide floor
Scene hard_far_away();        ///< hard_floor_and_box() below a node 1,000 km off
Scene hard_tiny();            ///< hard_floor_and_box() below a node of scale 1/100
Scene hard_field();           ///< boxes in rows
Scene hard_degenerate();      ///< a box some of whose triangles have no area
Scene hard_stretched();       ///< a turned box below a node of uneven scale
Scene hard_mirrored();        ///< below a node that mirrors x: a box and a single-sided plate
Scene hard_flattened();       ///< three boxes, two flattened by a scale of 0 to a plate and a point
Scene hard_plate_on_floor();  ///< a plate 1/64 m above a floor: hardly any depth
Scene hard_wires();           ///< wires of 1/128 m over a floor
Scene hard_slope();           ///< a slope that fills the map, and a bar over it
Scene hard_two_covers();      ///< covers at two heights
Scene hard_stairs();          ///< steps about a pixel high and wide
Scene hard_bar();             ///< a bar that crosses the sides of a small map
Scene hard_lamp();            ///< a floor, a sheet, a post and a beam about a lamp
Scene hard_high_sheet();      ///< a floor under a long sheet that is far above
Scene hard_blended_sheet();   ///< a sheet with holes of alpha
Scene hard_not_finite();      ///< a box, and a mesh with a vertex that is no number
Scene hard_many_vertices();   ///< a plate of more than 65,536 vertices
Scene hard_low_polygon();     ///< a ball of few facets with smooth normals
Scene hard_convex_bodies();   ///< convex bodies apart from each other

}  // namespace si
