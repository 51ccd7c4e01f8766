// SPDX-License-Identifier: Apache-2.0
#include "reader.h"

#include "file_io.h"
#include "load.h"

#include <new>

namespace spa::container {

struct File::Contents {
    Loaded loaded;
    std::unique_ptr<InputFile> input; // keeps the mapping
};

namespace {

Status load(Source& source, std::uint64_t size, const ReadOptions& options, LoadPart part,
            File::Contents& contents) {
    return load_file(source, size, options.limits, options.depth, part, contents.loaded);
}

Status load(std::span<const std::byte> bytes, const ReadOptions& options, LoadPart part,
            File::Contents& contents) {
    if (bytes.size() > options.limits.file_bytes)
        return at_byte(Issue::too_many_bytes, options.limits.file_bytes);
    Source source(bytes);
    return load(source, bytes.size(), options, part, contents);
}

Status load(const std::string& path, const ReadOptions& options, LoadPart part, File::Contents& contents) {
    if (const Status status = open_input(path, contents.input); !status.ok()) return status;
    InputFile& input = *contents.input;
    if (input.is_regular() && input.size() > options.limits.file_bytes)
        return at_byte(Issue::too_many_bytes, options.limits.file_bytes);
    if (options.map_file) {
        const std::span<const std::byte> bytes = input.map();
        if (!bytes.empty()) return load(bytes, options, part, contents);
    }
    const ReadExactly read_exactly = [&input](std::span<std::byte> out) { return input.read(out); };
    Source source(read_exactly);
    Status status = load(source, input.is_regular() ? input.size() : unknown_size, options, part, contents);
    if (status.ok() || input.error() == 0) return status;
    status = at_byte(Issue::cannot_read, source.position());
    status.system_error = input.error();
    return status;
}

// Runs `load_into` and keeps the contents only if all went well.
template <class Load>
Status load_or_empty(std::unique_ptr<File::Contents>& target, Load load_into) noexcept {
    target.reset();
    try {
        auto contents = std::make_unique<File::Contents>();
        const Status status = load_into(*contents);
        if (status.ok()) target = std::move(contents);
        return status;
    } catch (const std::bad_alloc&) {
        return at_byte(Issue::out_of_memory, 0);
    } catch (...) {
        return at_byte(Issue::cannot_read, 0);
    }
}

} // namespace

File::File() noexcept = default;
File::~File() = default;
File::File(File&&) noexcept = default;
File& File::operator=(File&&) noexcept = default;

const SphericalMap& File::map() const {
    static const SphericalMap empty;
    return contents_ ? contents_->loaded.map : empty;
}
Version File::version() const {
    if (!contents_) return {};
    return {contents_->loaded.structure.header.major, contents_->loaded.structure.header.minor};
}
std::uint64_t File::length() const { return contents_ ? contents_->loaded.structure.header.file_length : 0; }
std::span<const SectionEntry> File::sections() const {
    if (!contents_) return {};
    return contents_->loaded.structure.sections;
}

Status open(const std::string& path, File& file, const ReadOptions& options) noexcept {
    return load_or_empty(file.contents_,
                         [&](File::Contents& c) { return load(path, options, LoadPart::all, c); });
}

Status open(std::span<const std::byte> bytes, File& file, const ReadOptions& options) noexcept {
    return load_or_empty(file.contents_,
                         [&](File::Contents& c) { return load(bytes, options, LoadPart::all, c); });
}

Status read_metadata(const std::string& path, std::string& metadata, const Limits& limits) noexcept {
    metadata.clear();
    std::unique_ptr<File::Contents> contents;
    const Status status = load_or_empty(contents, [&](File::Contents& c) {
        return load(path, {limits, CheckDepth::full, true}, LoadPart::metadata, c);
    });
    if (status.ok()) metadata = std::move(contents->loaded.map.metadata);
    return status;
}

Status read(const ReadExactly& read_exactly, File& file, const ReadOptions& options) noexcept {
    return load_or_empty(file.contents_, [&](File::Contents& c) {
        Source source(read_exactly);
        return load(source, unknown_size, options, LoadPart::all, c);
    });
}

} // namespace spa::container
