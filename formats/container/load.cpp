// SPDX-License-Identifier: Apache-2.0
#include "load.h"

#include "checksum.h"
#include "codec.h"
#include "content.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace spa::container {
namespace {

ImageView* find_view(SphericalMap& map, const SectionEntry& entry) {
    Layer& layer = map.parts[entry.part].layers[entry.layer];
    Surface& surface = entry.side == std::uint16_t(Side::outer) ? layer.outer : layer.inner;
    switch (entry.type) {
    case type_depth: return &surface.depth;
    case type_normal: return &surface.normal;
    default: return &surface.color;
    }
}

Status cut_off(const Structure& structure, std::size_t section, const Source& source) {
    Status status = at_section(Issue::file_truncated, structure, section);
    status.offset = source.position();
    return status;
}

class Loader {
public:
    Loader(Source& source, const Limits& limits, CheckDepth depth, Loaded& loaded)
        : source_(source), limits_(limits), depth_(depth), loaded_(loaded), structure_(loaded.structure) {}

    Status read_front(std::uint64_t source_size) {
        // The identifier first: a short file of another kind is another kind of file.
        Bytes bytes;
        source_.take(identifier.size(), bytes);
        Status status = check_identifier(bytes.view);
        if (!status.ok()) return status;
        std::array<std::byte, header_size> header{};
        std::copy(bytes.view.begin(), bytes.view.end(), header.begin());
        if (!source_.take(header_size - identifier.size(), bytes))
            return at_byte(Issue::file_too_short, source_.position());
        std::copy(bytes.view.begin(), bytes.view.end(), header.begin() + identifier.size());
        status = check_header(header, limits_, structure_.header);
        if (!status.ok()) return status;
        if (source_size != unknown_size && source_size < structure_.header.file_length)
            return at_byte(Issue::file_truncated, source_size);
        if (source_size != unknown_size && source_size > structure_.header.file_length)
            return at_byte(Issue::file_too_long, structure_.header.file_length);
        Bytes table;
        if (!source_.take(std::uint64_t(structure_.header.section_count) * section_entry_size, table))
            return at_byte(Issue::file_truncated, source_.position());
        return check_table(header, table.view, limits_, structure_);
    }

    // Padding and checksum of PART are always checked: the parts decide what is read after them.
    Status read_parts() {
        Bytes bytes;
        Status status = read_stored(0, true, bytes);
        if (!status.ok()) return status;
        status = check_parts(bytes.view, limits_, structure_);
        if (!status.ok()) return status;
        status = check_images(structure_);
        if (!status.ok()) return status;
        for (const PartRecord& record : structure_.parts) {
            loaded_.map.parts.push_back(record.part);
            loaded_.map.parts.back().layers.resize(record.layer_count);
        }
        return {};
    }

    Status read_section(std::size_t i) {
        const SectionEntry& entry = structure_.sections[i];
        const bool full = depth_ == CheckDepth::full;
        if (!structure_.knows(entry.type)) return skip(i, full);
        if (entry.raw_length > std::uint64_t(PTRDIFF_MAX))
            return at_section(Issue::out_of_memory, structure_, i);
        Bytes bytes;
        Status status = read_stored(i, full, bytes);
        if (!status.ok()) return status;
        if (entry.scheme != Scheme::none) {
            std::vector<std::byte> raw;
            const Issue issue = decode_section(entry, bytes.view, raw);
            if (issue != Issue::none) return at_section(issue, structure_, i);
            bytes = {raw, {}};
            bytes.held = std::move(raw);
        }
        if (entry.type == type_metadata) {
            const std::string_view text(reinterpret_cast<const char*>(bytes.view.data()), bytes.view.size());
            if (full) status = check_metadata(structure_, i, text);
            loaded_.map.metadata = text;
            return status;
        }
        if (entry.type == type_bind) {
            Affine& to_node = loaded_.map.parts[entry.part].to_node;
            to_node = decode_bind(bytes.view.first<bind_size>());
            return check_bind(structure_, i, to_node);
        }
        if (entry.type == type_mixed)
            loaded_.map.parts[entry.part].mixed = bytes.view;
        else if (entry.type == type_fold)
            loaded_.map.parts[entry.part].folds = bytes.view;
        else
            *find_view(loaded_.map, entry) = {bytes.view, entry.width, entry.height, entry.format};
        if (!bytes.held.empty()) loaded_.buffers.push_back(std::move(bytes.held));
        return {};
    }

    // Up to the metadata, and no further.
    Status read_metadata() {
        for (std::size_t i = 1; i < structure_.sections.size(); ++i) {
            if (structure_.sections[i].type == type_metadata) return read_section(i);
            if (const Status status = skip(i, false); !status.ok()) return status;
        }
        return {};
    }

private:
    Status read_padding(std::size_t i, bool verify) {
        const std::uint64_t from = source_.position();
        Bytes padding;
        if (!source_.take(structure_.sections[i].offset - from, padding))
            return cut_off(structure_, i, source_);
        const auto bad = std::find_if(padding.view.begin(), padding.view.end(),
                                      [](std::byte b) { return b != std::byte{0}; });
        if (!verify || bad == padding.view.end()) return {};
        return at_byte(Issue::padding_not_zero, from + std::uint64_t(bad - padding.view.begin()));
    }

    Status read_stored(std::size_t i, bool verify, Bytes& bytes) {
        const Status status = read_padding(i, verify);
        if (!status.ok()) return status;
        if (!source_.take(structure_.sections[i].stored_length, bytes))
            return cut_off(structure_, i, source_);
        if (verify && checksum(bytes.view) != structure_.sections[i].checksum)
            return at_section(Issue::checksum_mismatch, structure_, i);
        return {};
    }

    // An unknown section may be larger than what is worth holding.
    Status skip(std::size_t i, bool verify) {
        constexpr std::uint64_t piece = std::uint64_t(1) << 20U;
        const Status status = read_padding(i, verify);
        if (!status.ok()) return status;
        RunningChecksum sum;
        for (std::uint64_t left = structure_.sections[i].stored_length; left > 0;) {
            Bytes bytes;
            if (!source_.take(std::min(piece, left), bytes)) return cut_off(structure_, i, source_);
            left -= bytes.view.size();
            if (verify) sum.add(bytes.view);
        }
        if (verify && sum.value() != structure_.sections[i].checksum)
            return at_section(Issue::checksum_mismatch, structure_, i);
        return {};
    }

    Source& source_;
    const Limits& limits_;
    CheckDepth depth_;
    Loaded& loaded_;
    Structure& structure_;
};

} // namespace

Status load_file(Source& source, std::uint64_t source_size, const Limits& limits, CheckDepth depth,
                 LoadPart part, Loaded& loaded) {
    Loader loader(source, limits, depth, loaded);
    Status status = loader.read_front(source_size);
    if (status.ok()) status = loader.read_parts();
    if (!status.ok() || part == LoadPart::nothing) return status;
    if (part == LoadPart::metadata) return loader.read_metadata();
    for (std::size_t i = 1; i < loaded.structure.sections.size(); ++i) {
        status = loader.read_section(i);
        if (!status.ok()) return status;
    }
    return depth == CheckDepth::full ? check_content(loaded.structure, loaded.map) : Status{};
}

} // namespace spa::container
