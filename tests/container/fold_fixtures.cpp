// SPDX-License-Identifier: Apache-2.0
#include "issue_fixtures.h"

#include "test_maps.h"

#include "../../libspa/core/cell_triangles.h"

#include <algorithm>

namespace spa::test {

using namespace spa::container;

namespace {

FileBytes with_fold_value(std::size_t field, std::uint32_t value) {
    return with_entry_value(type_fold, field, value);
}

void remove(FileParts& parts, std::uint32_t type) {
    std::erase_if(parts.sections, [type](const Section& s) { return s.entry.type == type; });
}

// Fold records that are not decoded, as many bytes as given.
FileBytes with_fold_bytes(std::size_t count) {
    return edited(good_file(), [count](FileParts& f) {
        Section& section = f.find(type_fold);
        section.stored.resize(count);
        section.entry.raw_length = count;
    });
}

FoldRecord pair(std::uint32_t edge, unsigned end, unsigned index) {
    return {edge, true, std::uint8_t(end), std::uint8_t(index), 127, {30000, 20000}};
}
FoldRecord single(std::uint32_t edge, unsigned end, unsigned index) {
    return {edge, false, std::uint8_t(end), std::uint8_t(index), 127, {30000, 0}};
}

} // namespace

FileBytes with_folds(const std::vector<FoldRecord>& records, const std::vector<std::uint64_t>& pure) {
    return edited(good_file(), [&](FileParts& f) {
        FileBytes& bits = f.find(type_mixed).stored;
        std::fill(bits.begin(), bits.end(), std::byte{0xFF});
        for (const std::uint64_t bit : pure) bits[std::size_t(bit / 8)] ^= std::byte(1U << unsigned(bit % 8));
        Section& section = f.find(type_fold);
        section.stored = encode_folds(records);
        section.entry.raw_length = section.stored.size();
    });
}

Fixtures fold_fixtures() {
    return {
        {Issue::wrong_required_flag, [] { return with_fold_value(4, flag_required); }},
        {Issue::wrong_scheme, [] { return with_fold_value(16, 2); }},
        {Issue::duplicate_section,
         [] { return edited(good_file(), [](FileParts& f) { f.sections.push_back(f.find(type_fold)); }); }},
        {Issue::fold_fields_not_zero, [] { return with_fold_value(12, 1); }},
        {Issue::fold_fields_not_zero, [] { return with_fold_value(12, 0x10000); }},
        {Issue::fold_fields_not_zero, [] { return with_fold_value(20, 2); }},
        {Issue::fold_fields_not_zero, [] { return with_fold_value(24, 5); }},
        {Issue::fold_fields_not_zero, [] { return with_fold_value(28, 5); }},
        {Issue::fold_part_not_valid, [] { return with_fold_value(8, 1); }},
        {Issue::fold_part_not_valid,
         [] { return edited(good_file(), [](FileParts& f) { remove(f, type_mixed); }); }},
        {Issue::fold_part_not_valid,
         [] {
             return edited(good_file(), [](FileParts& f) {
                 store(f.sections[0].stored.data() + 104, std::uint32_t(Mapping::latlong));
                 remove(f, type_mixed);
             });
         }},
        {Issue::wrong_fold_length, [] { return with_fold_bytes(0); }},
        {Issue::wrong_fold_length, [] { return with_fold_bytes(9); }},
        {Issue::wrong_fold_length, [] { return with_fold_bytes(121); }},
        {Issue::wrong_fold_length, [] { return with_fold_bytes(3 * 5 * 5 * 64 * 10 + 10); }},

        // 4 cells: a row of samples has 15 numbers, of which the last 3 are those of column 4.
        {Issue::fold_edge_not_valid, [] { return with_folds({single(12, 0, 0)}); }},
        {Issue::fold_edge_not_valid, [] { return with_folds({single(14, 0, 0)}); }},
        {Issue::fold_edge_not_valid, [] { return with_folds({single(61, 0, 0)}); }},
        {Issue::fold_edge_not_valid, [] { return with_folds({single(62, 0, 0)}); }},
        {Issue::fold_edge_not_valid, [] { return with_folds({single(75, 0, 0)}); }},
        {Issue::fold_edge_not_valid, [] { return with_folds({single(76, 0, 0)}); }},
        {Issue::fold_edge_not_valid, [] { return with_folds({single(0xFFFFFFFF, 0, 0)}); }},
        {Issue::fold_edge_not_valid,
         [] {
             return with_folds({single(3, 0, 0), single(2, 0, 0)});
         }},
        {Issue::fold_index_not_valid, [] { return with_folds({single(0, 0, 3)}); }},
        {Issue::fold_index_not_valid, [] { return with_folds({single(0, 1, 63)}); }},
        {Issue::fold_index_not_valid, [] { return with_folds({pair(0, 1, 2)}); }},
        {Issue::fold_index_not_valid,
         [] {
             return with_folds({pair(0, 0, 1), single(0, 0, 1)});
         }},
        {Issue::fold_index_not_valid,
         [] {
             return with_folds({single(0, 0, 0), pair(0, 0, 1)});
         }},
        {Issue::fold_index_not_valid,
         [] {
             // A sample without surfaces.
             return edited(with_folds({single(36, 0, 0)}), [](FileParts& f) {
                 for (Section& section : f.sections)
                     if (section.entry.type == type_depth)
                         store(section.stored.data() + 24, std::uint16_t(0));
             });
         }},
        {Issue::fold_index_not_valid,
         [] {
             // The outermost interval reaches the centre, and no other is left.
             return edited(with_folds({single(36, 0, 1)}), [](FileParts& f) {
                 store(f.find(type_depth, 0, 0, Side::inner).stored.data() + 24, std::uint16_t(0));
                 store(f.find(type_depth, 0, 1).stored.data() + 24, std::uint16_t(0));
             });
         }},
        {Issue::fold_cut_not_valid,
         [] {
             return with_folds({{0, false, 0, 0, 9, {0, 0}}});
         }},
        {Issue::fold_cut_not_valid,
         [] {
             return with_folds({{0, false, 0, 0, 9, {1, 1}}});
         }},
        {Issue::fold_cut_not_valid,
         [] {
             return with_folds({{0, true, 0, 0, 9, {1, 0}}});
         }},
        {Issue::fold_cut_not_valid,
         [] {
             return with_folds({{0, true, 0, 0, 9, {0, 1}}});
         }},
        {Issue::fold_on_pure_triangle,
         [] { return with_folds({single(9, 0, 0)}, {triangle_bit(4, 3, 0, 1)}); }},
        {Issue::fold_on_pure_triangle,
         [] { return with_folds({single(18, 0, 0)}, {triangle_bit(4, 1, 1, 1)}); }},
        {Issue::fold_on_pure_triangle,
         [] { return with_folds({single(18, 0, 0)}, {triangle_bit(4, 1, 0, 0)}); }},
        {Issue::fold_on_pure_triangle,
         [] { return with_folds({single(55, 0, 0)}, {triangle_bit(4, 3, 3, 0)}); }},
        {Issue::fold_on_pure_triangle,
         [] { return with_folds({single(55, 0, 0)}, {triangle_bit(4, 2, 3, 1)}); }},
        {Issue::fold_on_pure_triangle,
         [] { return with_folds({single(20, 0, 0)}, {triangle_bit(4, 1, 1, 0)}); }},
        {Issue::fold_on_pure_triangle,
         [] { return with_folds({single(20, 0, 0)}, {triangle_bit(4, 1, 1, 1)}); }},
    };
}

} // namespace spa::test
