// SPDX-License-Identifier: Apache-2.0
// container_seeds FOLDER: writes the seed corpus, one small valid file of each kind.
#include "../container/file_parts.h"
#include "../container/old_versions.h"
#include "../container/test_maps.h"

#include <fstream>

namespace {

using namespace spa;
using namespace spa::test;

bool save(const std::string& path, const FileBytes& bytes) {
    std::ofstream stream(path, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    return bool(stream);
}

FileBytes with_unknown_section(const FileBytes& file) {
    FileParts parts = take_apart(file);
    Section section;
    section.entry.type = container::section_type("XTRA");
    section.stored.resize(5);
    parts.sections.push_back(section);
    parts.minor = container::version_minor + 1;
    return put_together(parts);
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 2) return 1;
    const std::string folder = std::string(argv[1]) + "/";
    using enum ElementFormat;
    TestPart small;
    small.width = small.height = small.color_width = small.color_height = 3;
    TestPart bytes = small;
    bytes.depth = u8;
    bytes.normal = oct8;
    bytes.solid_core = false;
    TestPart floats = small;
    floats.mapping = Mapping::latlong;
    floats.depth = f32;
    floats.normal = rgb8;
    floats.layers = 1;
    const TestMap map = make_map({small, bytes, floats});
    const TestMap large = make_map({TestPart{.width = 17, .height = 17}});
    const FileBytes plain = write(map.map);
    const bool done = save(folder + "example.spa", write(make_example().map)) &&
                      save(folder + "plain.spa", plain) &&
                      save(folder + "version_1_0.spa", version_1_0_file()) &&
                      save(folder + "version_1_1.spa", version_1_1_file()) &&
                      save(folder + "unknown.spa", with_unknown_section(plain)) &&
                      save(folder + "zstd.spa", write(large.map, container::Compression::zstd));
    return done ? 0 : 2;
}
