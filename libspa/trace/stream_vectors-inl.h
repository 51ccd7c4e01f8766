// SPDX-License-Identifier: Apache-2.0
// Short names for the vectors of a stream trace, once for each instruction set (Highway's per-target header).
#if defined(SPA_STREAM_VECTORS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPA_STREAM_VECTORS_INL
#undef SPA_STREAM_VECTORS_INL
#else
#define SPA_STREAM_VECTORS_INL
#endif

#include "stream_block.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace spa::trace::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using DF = hn::ScalableTag<float>;
using DU = hn::ScalableTag<std::uint32_t>;
using DI = hn::ScalableTag<std::int32_t>;
constexpr DF df;
constexpr DU du;
constexpr DI di;
using VF = hn::Vec<DF>;
using VU = hn::Vec<DU>;
using VI = hn::Vec<DI>;
using MF = hn::Mask<DF>;
using MU = hn::Mask<DU>;

// Of integers below 2^24.
HWY_INLINE VF to_floats(VU integers) { return hn::ConvertTo(df, hn::BitCast(di, integers)); }
// Towards zero; of values in [0, 2^31).
HWY_INLINE VU to_words(VF values) { return hn::BitCast(du, hn::ConvertTo(di, values)); }

HWY_INLINE MF select_mask(MF mask, MF yes, MF no) { return hn::Or(hn::And(mask, yes), hn::AndNot(mask, no)); }

HWY_INLINE MU no_word_lanes() { return hn::MaskFromVec(hn::Zero(du)); }
HWY_INLINE MF no_lanes() { return hn::RebindMask(df, no_word_lanes()); }

HWY_INLINE VU gather(const std::uint32_t* words, VU index) {
    return hn::GatherIndex(du, words, hn::BitCast(di, index));
}

// The lanes of `keep`, one behind the other, at `to`; what follows them there is overwritten up to a whole
// vector.
template <class V, class M, class T>
HWY_INLINE void append(V values, M keep, T* to) {
    hn::StoreU(hn::Compress(values, keep), hn::DFromV<V>(), to);
}

} // namespace spa::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
