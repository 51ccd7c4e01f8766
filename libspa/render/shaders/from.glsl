// SPDX-License-Identifier: Apache-2.0
// What a ray starts on, for which some hits do not count (docs/rendering.md, "Where rays start").
#ifndef SPA_RENDER_FROM_GLSL
#define SPA_RENDER_FROM_GLSL

#define FROM_ELSEWHERE 0u
#define FROM_OBJECT 1u // that a map replaces, whether it was hit as triangles or as a map: maps cull back hits
#define FROM_MAP 2u    // a map itself: the triangles that maps replace cull their backs

#endif
