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

// Packs the lanes of a mask, one behind the other. What follows them in memory is overwritten up to a whole
// vector.
class Packer {
public:
#if HWY_TARGET == HWY_AVX3
    HWY_INLINE explicit Packer(MU mask) : mask_(mask) {}

    HWY_INLINE void operator()(VF values, float* to) const {
        hn::StoreU(hn::Compress(values, hn::RebindMask(df, mask_)), df, to);
    }
    HWY_INLINE void operator()(VU values, std::uint32_t* to) const {
        hn::StoreU(hn::Compress(values, mask_), du, to);
    }

private:
    MU mask_;
#else
    // Not Highway's Compress: GCC copies its table of permutations at every call (Highway 1.0.3).
    HWY_INLINE explicit Packer(MU mask) : sources_(sources(mask)) {}

    HWY_INLINE void operator()(VF values, float* to) const {
        hn::StoreU(hn::TableLookupLanes(values, hn::IndicesFromVec(df, sources_)), df, to);
    }
    HWY_INLINE void operator()(VU values, std::uint32_t* to) const {
        hn::StoreU(hn::TableLookupLanes(values, hn::IndicesFromVec(du, sources_)), du, to);
    }

private:
    static HWY_INLINE VI sources(MU mask) {
        HWY_ALIGN std::uint32_t wanted[hn::MaxLanes(du)];
        HWY_ALIGN std::int32_t lanes[hn::MaxLanes(du) + 1] = {};
        hn::Store(hn::VecFromMask(du, mask), du, wanted);
        std::size_t count = 0;
        for (std::size_t i = 0; i < hn::Lanes(du); ++i) {
            lanes[count] = std::int32_t(i);
            count += wanted[i] & 1U;
        }
        return hn::Load(di, lanes);
    }

    VI sources_;
#endif
};

} // namespace spa::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
