// SPDX-License-Identifier: Apache-2.0
// Whether a tracer's answer is right, by the judge.
//
// An answer agrees if t is within `time_bound` of the judge's (more by the length of the core's chord, where
// the hit is in the core) and what it says of the surface is what is there. Where it does not, rounding may
// decide: rays moved sideways by 1e-5 and 1e-6 R, limits of t moved by as much, and rays moved by no more
// than 1e-5 R to points just inside of what the traced point is next to, are judged too.
//   A miss is excused if one of those misses, or if they are nowhere all in the solid: a ray in the plane of
//   a wall may be on either side of it from one triangle to the next. A hit is excused if one of those meets
//   nothing earlier, or they are nowhere all in the solid before it; and one has a hit there, or the point
//   lies on a face by which the ray enters or leaves, or t lies between their hits and on the boundary of the
//   solid.
//   If those rays meet the solid differently often, or first something else, the ray runs within 1e-5 R of
//   edges all along, and rounding may take it to one side here and to the other there: a hit on the boundary
//   is "bent", and so is a miss where hits are culled or walls open.
//   Solid that is less than 1e-5 R long on a ray and ends at a wall is the tip of a wedge: a ray in the plane
//   of a triangle's side has only its edge, of no length, on the one side of that plane, so any of those rays
//   may pass it by. (With folds walls end in tips where lines come to a sample or an edge of a triangle;
//   intervals of no thickness have no wall and are hit.) Through the line of a sample, where up to eight
//   triangles meet, what is left may be a wall at the edge of any of them, and so may its normal.
//   The bound of a hit on a plane that the ray meets at a sine below 0.01 is divided by it, and an edge up to
//   four bounds away may have been passed: that far along the ray its distance from the plane is rounding.
//   Where the line of an open wall comes to the border of a triangle the ray may go by the border, a closed
//   wall, if the border is there.
// Rays that pass the centre at less than the largest W's distance, where the core is 64 times smaller than
// that, lose digits: their bound grows by 4 eps W_core R, and it is enough that their hits are on the
// boundary. Whatever is excused is counted, hits on the other face of an edge apart from the rest.
#pragma once

#include "judge.h"

#include <array>
#include <string>

namespace spa::test {

enum class Verdict : unsigned {
    agrees,
    beside,       // t agrees; at an edge the record is of the other face
    excused,      // rounding decides
    bent,         // the ray runs along edges, and its answer belongs to neither side of them
    core,         // right but for the digits that a ray loses next to the centre
    missed,       // a hit is missing
    invented,     // a hit where there is none
    wrong_time,   // t is beyond the bound
    wrong_record, // t is right; side, front, layer or normal belong to nothing that is there
    invalid,      // NaN, or outside the limits of t or of the map
};
constexpr std::size_t verdict_count = 10;
const char* name(Verdict verdict);
// Whether it says that the answer is right.
constexpr bool is_right(Verdict verdict) {
    return verdict == Verdict::agrees || verdict == Verdict::beside || verdict == Verdict::excused ||
           verdict == Verdict::bent || verdict == Verdict::core;
}

// 1e-5 R, and beyond 20 R what the rounding of the ray's own points amounts to.
double time_bound(const trace::Ray& ray);

struct Judgement {
    Verdict verdict = Verdict::agrees;
    double dt = 0; // in units of R; 0 unless both hit
    bool hit = false;
};

// ray, hit: in map space, as closest_hit takes and gives them. bound: of |dt| in units of R.
Judgement judge_hit(const Judge& judge, const trace::Ray& ray, std::uint32_t flags, const trace::Hit& hit,
                    double bound);

// The ray and both answers, to run it again.
std::string describe(const Judge& judge, const trace::Ray& ray, std::uint32_t flags, const trace::Hit& hit);

} // namespace spa::test
