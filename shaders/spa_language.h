// SPDX-License-Identifier: Apache-2.0
// What the tracing text needs of its language: C++20, GLSL (460 and ES 3.00) or HLSL.
//
// The text keeps to what all of them share: float2/float3 and uint, structs returned by value, member-wise
// assignment, no default arguments, no global constants, no recursion. No call that changes anything stands
// in an operand of &&, || or ?:, because HLSL evaluates all of them. This file maps the rest:
//   SPA_IN(type)     a parameter that is read, of a struct's type
//   SPA_OUT(type)    a parameter that is written
//   SPA_INOUT(type)  a parameter that is read and written
//   spa_bits(f), spa_float(u)   a float's pattern, and back
//   SpaWords, spa_load(words, index)   the words of one trace image (spa_map.h)
//
// An application says where the words are:
//   C++                   SpaWords{pointer}
//   GLSL 460              before the include: #define SPA_LOAD(index) image_words[index], over a buffer or
//                         texture of its own (not called `words`, which is a parameter here); SpaWords is the
//                         index of the image's first word in it
//   GLSL ES 3.00          the same, for example #define SPA_LOAD(index) texelFetch(image_words,
//                         ivec2((index) & 1023u, (index) >> 10u), 0).x
//   HLSL                  the same, for example #define SPA_LOAD(index) image_words.Load(4 * (index)); and
//                         before the include #define SPA_HLSL
#ifndef SPA_LANGUAGE_H
#define SPA_LANGUAGE_H

#if defined(__cplusplus)

#include <bit>
#include <cmath>
#include <cstdint>

#define SPA_IN(type) const type&
#define SPA_OUT(type) type&
#define SPA_INOUT(type) type&
#define SPA_FUNCTION inline

namespace spa::shader {

using uint = std::uint32_t;

struct float2 {
    float x = 0, y = 0;
    float2() = default;
    float2(float x_, float y_) : x(x_), y(y_) {}
};
struct float3 {
    float x = 0, y = 0, z = 0;
    float3() = default;
    float3(float x_, float y_, float z_) : x(x_), y(y_), z(z_) {}
};

inline float2 operator+(float2 a, float2 b) { return {a.x + b.x, a.y + b.y}; }
inline float2 operator-(float2 a, float2 b) { return {a.x - b.x, a.y - b.y}; }
inline float2 operator*(float2 a, float s) { return {a.x * s, a.y * s}; }
inline float3 operator+(float3 a, float3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline float3 operator-(float3 a, float3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline float3 operator*(float3 a, float s) { return {a.x * s, a.y * s, a.z * s}; }
inline float dot(float3 a, float3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

// As processors have it, so that vectors and scalars agree about zeros and NaN: the second if they are not
// ordered.
inline float min(float a, float b) { return a < b ? a : b; }
inline float max(float a, float b) { return a > b ? a : b; }
inline uint min(uint a, uint b) { return b < a ? b : a; }
inline uint max(uint a, uint b) { return a < b ? b : a; }
inline float abs(float a) { return std::fabs(a); }
inline float floor(float a) { return std::floor(a); }
inline float sqrt(float a) { return std::sqrt(a); }

inline uint spa_bits(float a) { return std::bit_cast<uint>(a); }
inline float spa_float(uint a) { return std::bit_cast<float>(a); }

struct SpaWords {
    const uint* first = nullptr;
};
inline uint spa_load(SpaWords words, uint index) { return words.first[index]; }

} // namespace spa::shader

#define SPA_BEGIN namespace spa::shader {
#define SPA_END }

#else // GLSL or HLSL

#define SPA_IN(type) type
#define SPA_OUT(type) out type
#define SPA_INOUT(type) inout type
#define SPA_FUNCTION
#define SPA_BEGIN
#define SPA_END

#if defined(SPA_HLSL)
#define spa_bits(a) asuint(a)
#define spa_float(a) asfloat(a)
#else
#define float2 vec2
#define float3 vec3
#define spa_bits(a) floatBitsToUint(a)
#define spa_float(a) uintBitsToFloat(a)
#endif

#define SpaWords uint
uint spa_load(SpaWords words, uint index) { return SPA_LOAD(words + index); }

#endif

#endif
