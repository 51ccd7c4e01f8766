// SPDX-License-Identifier: Apache-2.0
// Tracing rays through a spherical map, in one text for C++20, GLSL (460 and ES 3.00) and HLSL.
// README.md in this folder explains the projective trace with a picture.
//
// Order of operations:
//   1. Compile a part of a map into a trace image, an array of 32-bit words (libspa/trace/trace_map.h), and
//      hand it to the shader in any buffer.
//   2. Define SPA_LOAD (spa_language.h) and include this file.
//   3. SpaMap map = spa_open(words);
//   4. Bring the ray into map space: the part's frame, the centre at the origin, in units of its radius R
//      (SPA.md, "Parts": p = c + M q; map space is q/R). Do not normalise the direction: t stays what it was.
//   5. spa_trace_projective, spa_trace_fan or spa_trace_march; true means a hit.
//   6. spa_shade for the stored colour and normal at the hit.
//
// Any ray may be given: one with NaN or infinite members, or without direction, misses. No function recurses,
// none needs a stack, every loop is bounded. Nothing is read outside the trace image.
#ifndef SPA_TRACE_H
#define SPA_TRACE_H

#include "spa_fan.h"
#include "spa_march.h"
#include "spa_projective.h"
#include "spa_shade.h"

#endif
