// SPDX-License-Identifier: Apache-2.0
// The Direct3D loader against a device of the test's own: what it uploads, in which order it records, what it
// says of instances, and that failures leave nothing behind.
#include "../../libspa/dxr/map_object.h"

#include "fake_command_list.h"
#include "fake_device.h"

#include "../../libspa/bake/bake.h"
#include "../../libspa/core/error.h"
#include "../../libspa/trace/space.h"
#include "../../samples/samples.h"
#include "../../shaders/spa_hit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

namespace spa::test {
namespace {

// A map of three parts: octahedral with one layer and with two, and latlong, each in a frame of its own.
struct Baked {
    std::array<bake::Result, 3> results;
    SphericalMap map;
};

const Baked& baked() {
    static const Baked made = [] {
        Baked result;
        const std::array<Grid, 3> grids{
            {{Mapping::octahedral, 17, 17}, {Mapping::octahedral, 25, 25}, {Mapping::latlong, 24, 12}}};
        const std::array<const char*, 3> names{"smooth", "concave", "boot"};
        const std::array<std::uint32_t, 3> layers{1, 2, 1};
        for (std::size_t i = 0; i < grids.size(); ++i) {
            bake::Options options;
            options.grid = options.color_grid = grids[i];
            options.layers = layers[i];
            options.frame = bake::Frame::sphere;
            result.results[i] = bake::bake_model(samples::make_sample(names[i], 1), options);
            result.map.parts.push_back(result.results[i].map.map.parts.front());
        }
        result.map.parts[1].frame = {{{0.5, 0.1, 0}, {0, -2, 0.3}, {0.2, 0, 1}}};
        return result;
    }();
    return made;
}

class DxrMapObject : public testing::Test {
protected:
    void TearDown() override {
        for (const std::string& problem : device.problems) ADD_FAILURE() << problem;
        EXPECT_TRUE(device.alive.empty()) << "resources are leaked";
        EXPECT_EQ(device.references, 1U);
        EXPECT_EQ(commands.references, 1U);
    }

    // The words of a part's image, as they are on the device now.
    std::vector<std::uint32_t> words_at(D3D12_GPU_VIRTUAL_ADDRESS address, std::size_t count) {
        std::vector<std::uint32_t> words(count);
        const FakeResource* resource = device.at(address, count * sizeof(std::uint32_t));
        if (resource != nullptr)
            std::memcpy(words.data(), resource->bytes.data() + (address - resource->address),
                        count * sizeof(std::uint32_t));
        return words;
    }

    FakeDevice device;
    FakeCommandList commands{device};
};

TEST_F(DxrMapObject, PutsTheTraceImagesOnTheDevice) {
    for (const bool images : {true, false}) {
        dxr::LoadOptions options;
        options.compile.images = images;
        dxr::MapObject object(&device, baked().map, options);
        object.record(&commands);
        object.finish();
        ASSERT_EQ(object.part_count(), 3U);
        for (std::uint32_t part = 0; part < 3; ++part) {
            const trace::TraceMap expected(baked().map.parts[part], options.compile);
            const dxr::ShaderRecord record = object.shader_record(part);
            EXPECT_EQ(record.image % 256, 0U);
            EXPECT_EQ(record.part, part);
            EXPECT_TRUE(std::ranges::equal(words_at(record.image, expected.words().size()), expected.words()))
                << part;
        }
    }
}

TEST_F(DxrMapObject, CompilesAsManyLayersAsAskedFor) {
    dxr::LoadOptions options;
    options.compile.layers = 1;
    dxr::MapObject object(&device, baked().map, options);
    object.record(&commands);
    const trace::TraceMap expected(baked().map.parts[1], options.compile);
    EXPECT_TRUE(std::ranges::equal(words_at(object.shader_record(1).image, expected.words().size()),
                                   expected.words()));
}

TEST_F(DxrMapObject, BuildsOneStructureOfTheImagesBoxAPart) {
    dxr::MapObject object(&device, baked().map);
    object.record(&commands);
    ASSERT_EQ(commands.structures.size(), 3U);
    for (std::uint32_t part = 0; part < 3; ++part) {
        const auto found = commands.structures.find(object.structure(part));
        ASSERT_NE(found, commands.structures.end());
        EXPECT_TRUE(found->second.visible) << "no barrier comes behind the build";
        EXPECT_EQ(found->second.flags, D3D12_RAYTRACING_GEOMETRY_FLAG_OPAQUE);
        const trace::TraceMap image(baked().map.parts[part]);
        const D3D12_RAYTRACING_AABB& box = found->second.box;
        const bool octahedral = baked().map.parts[part].mapping == Mapping::octahedral;
        const auto near = [&](float edge, float stored, float outward) {
            const float expected = octahedral ? stored : outward;
            EXPECT_GE((edge - expected) * outward, 0.0F);
            EXPECT_LE((edge - expected) * outward, 2e-6F);
        };
        near(box.MinX, image.map().box_low.x, -1);
        near(box.MinY, image.map().box_low.y, -1);
        near(box.MinZ, image.map().box_low.z, -1);
        near(box.MaxX, image.map().box_high.x, 1);
        near(box.MaxY, image.map().box_high.y, 1);
        near(box.MaxZ, image.map().box_high.z, 1);
    }
}

TEST_F(DxrMapObject, TakesTheSpheresBoxIfAsked) {
    dxr::LoadOptions options;
    options.whole_sphere = true;
    dxr::MapObject object(&device, baked().map, options);
    object.record(&commands);
    for (const auto& [address, built] : commands.structures) {
        EXPECT_EQ(built.box.MinX, -1.0F);
        EXPECT_EQ(built.box.MaxZ, 1.0F);
    }
}

TEST_F(DxrMapObject, RecordsCopyBarrierBuildsBarrier) {
    dxr::MapObject object(&device, baked().map);
    EXPECT_TRUE(commands.commands.empty());
    object.record(&commands);
    EXPECT_EQ(commands.commands,
              (std::vector<std::string>{"copy", "transition", "build", "build", "build", "uav"}));
}

TEST_F(DxrMapObject, KeepsTwoBuffersAndTellsTheirSize) {
    dxr::MapObject object(&device, baked().map);
    EXPECT_EQ(device.alive.size(), 4U);
    const auto total = [&] {
        std::uint64_t size = 0;
        for (const FakeResource* resource : device.alive) size += resource->description.Width;
        return size;
    };
    const dxr::MemoryUsed& memory = object.memory();
    EXPECT_EQ(memory.images + memory.structures + memory.temporary, total());
    EXPECT_EQ(memory.structures, 3U * 1024); // 1000 each
    object.record(&commands);
    object.finish();
    EXPECT_EQ(device.alive.size(), 2U);
    EXPECT_EQ(memory.temporary, 0U);
    EXPECT_EQ(memory.images + memory.structures, total());
    object.finish(); // again: nothing
    EXPECT_EQ(device.alive.size(), 2U);
}

TEST_F(DxrMapObject, DoesWithoutScratchWhereADeviceNeedsNone) {
    device.scratch_size = 0;
    dxr::MapObject object(&device, baked().map);
    object.record(&commands);
    EXPECT_EQ(device.alive.size(), 3U);
}

TEST_F(DxrMapObject, MovesWithItsBuffers) {
    dxr::MapObject object(&device, baked().map);
    const dxr::ShaderRecord before = object.shader_record(1);
    dxr::MapObject moved = std::move(object);
    moved.record(&commands);
    EXPECT_EQ(moved.shader_record(1).image, before.image);
    moved = dxr::MapObject(&device, baked().map);
    EXPECT_EQ(device.alive.size(), 4U);
}

TEST_F(DxrMapObject, InstancesAreMapSpace) {
    const Affine turned{{{{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}}}, {}};
    const std::array<Affine, 4> transforms{{
        {},
        {{{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {4, 5, 6}},                  // mirrored
        {{{{1, 0.75, 0}, {0, 2, -0.5}, {0.25, 0, 0.01}}}, {-1e3, 2, 1e-3}}, // sheared
        turned * Affine{{{{-3, 1, 0.5}, {0.125, 2, 0}, {1, 1, -1}}}, {1, 2, 3}},
    }};
    const dxr::MapObject object(&device, baked().map);
    for (const Affine& transform : transforms)
        for (std::uint32_t part = 0; part < 3; ++part) {
            const D3D12_RAYTRACING_INSTANCE_DESC instance = object.instance(part, transform);
            const trace::MapSpace space = trace::map_space(baked().map.parts[part], transform);
            const std::array<double, 3> origin{space.origin.x, space.origin.y, space.origin.z};
            for (std::size_t i = 0; i < 3; ++i) {
                const Vec3d& row = space.to_world.row[i];
                const std::array<double, 4> expected{row.x, row.y, row.z, origin[i]};
                for (std::size_t j = 0; j < 4; ++j)
                    EXPECT_NEAR(double(instance.Transform[i][j]), expected[j], std::abs(expected[j]) * 6e-8);
            }
            EXPECT_EQ(instance.AccelerationStructure, object.structure(part));
            EXPECT_EQ(instance.AccelerationStructure % 256, 0U);
        }
}

// A map-space point by the matrix is the same point of the part's own formula, p = center + frame * (radius *
// q).
TEST_F(DxrMapObject, InstancesPutPointsWhereTheFileFormatSays) {
    const dxr::MapObject object(&device, baked().map);
    const Affine mirrored{{{{-2, 0, 0.5}, {0, 1, 0}, {0, 0.25, 3}}}, {10, 20, 30}};
    for (std::uint32_t index = 0; index < 3; ++index) {
        const D3D12_RAYTRACING_INSTANCE_DESC instance = object.instance(index, mirrored);
        const Part& part = baked().map.parts[index];
        const Vec3d q{0.25, -0.5, 0.75};
        const Vec3d p = transform_point(mirrored, part.center + part.frame * (q * part.radius));
        const std::array<double, 3> expected{p.x, p.y, p.z};
        for (std::size_t i = 0; i < 3; ++i) {
            const auto& row = instance.Transform[i];
            const double value =
                double(row[0]) * q.x + double(row[1]) * q.y + double(row[2]) * q.z + double(row[3]);
            EXPECT_NEAR(value, expected[i], 1e-5);
        }
    }
}

TEST_F(DxrMapObject, InstancesTakeTheApplicationsNumbers) {
    const dxr::MapObject object(&device, baked().map);
    dxr::InstanceOptions options;
    EXPECT_EQ(object.instance(0, {}, options).InstanceMask, 0xFFU);
    options.id = 0xABCDEF;
    options.mask = 0x5A;
    options.hit_record = 0x123456;
    options.flags = D3D12_RAYTRACING_INSTANCE_FLAG_FORCE_NON_OPAQUE;
    const D3D12_RAYTRACING_INSTANCE_DESC instance = object.instance(2, {}, options);
    EXPECT_EQ(instance.InstanceID, 0xABCDEFU);
    EXPECT_EQ(instance.InstanceMask, 0x5AU);
    EXPECT_EQ(instance.InstanceContributionToHitGroupIndex, 0x123456U);
    EXPECT_EQ(instance.Flags, UINT(D3D12_RAYTRACING_INSTANCE_FLAG_FORCE_NON_OPAQUE));
}

TEST_F(DxrMapObject, CoverageCallsAnyHitAndMarksRecords) {
    dxr::LoadOptions options;
    options.coverage = true;
    dxr::MapObject object(&device, baked().map, options);
    object.record(&commands);
    for (const auto& [address, built] : commands.structures)
        EXPECT_EQ(built.flags & D3D12_RAYTRACING_GEOMETRY_FLAG_OPAQUE, 0);
    EXPECT_EQ(object.shader_record(0, SPA_CULL_BACK).flags, SPA_CULL_BACK | SPA_RECORD_COVERAGE);
    EXPECT_EQ(object.query_record(0).flags, SPA_RECORD_COVERAGE);
}

TEST_F(DxrMapObject, QueryRecordsCountWordsOfTheView) {
    dxr::MapObject object(&device, baked().map);
    object.record(&commands);
    const D3D12_SHADER_RESOURCE_VIEW_DESC view = object.images_view();
    EXPECT_EQ(view.ViewDimension, D3D12_SRV_DIMENSION_BUFFER);
    EXPECT_EQ(view.Buffer.Flags, D3D12_BUFFER_SRV_FLAG_RAW);
    EXPECT_EQ(view.Format, DXGI_FORMAT_R32_TYPELESS);
    EXPECT_LE(view.Buffer.NumElements * 4ULL, object.memory().images);
    for (std::uint32_t part = 0; part < 3; ++part) {
        const dxr::QueryRecord record = object.query_record(part, 7, SPA_CULL_FRONT);
        EXPECT_EQ(object.images()->GetGPUVirtualAddress() + 4ULL * record.first_word,
                  object.shader_record(part).image);
        EXPECT_EQ(record.buffer, 7U);
        EXPECT_EQ(record.flags, SPA_CULL_FRONT);
        EXPECT_EQ(record.part, part);
        const trace::TraceMap image(baked().map.parts[part]);
        EXPECT_LE(record.first_word + image.words().size(), view.Buffer.NumElements);
    }
}

// What a call throws; ok if nothing.
template <class Call>
ExitCode thrown_by(const Call& call) {
    try {
        call();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()), "");
        return error.code();
    }
    return ExitCode::ok;
}

TEST_F(DxrMapObject, EveryFailureIsAnErrorThatLeavesNothing) {
    { const dxr::MapObject counted(&device, baked().map); }
    const int fallible = device.calls;
    EXPECT_EQ(fallible, 6); // the tier, four buffers, one mapping
    struct Case {
        std::uint32_t failure;
        ExitCode code;
    };
    for (const Case& test : {Case{0x80004005U, ExitCode::internal}, Case{0x8007000EU, ExitCode::unsupported},
                             Case{0x887A0005U, ExitCode::unsupported}})
        for (int call = 0; call < fallible; ++call) {
            device.calls = 0;
            device.failing_call = call;
            device.failure = HRESULT(test.failure);
            EXPECT_EQ(thrown_by([&] { const dxr::MapObject object(&device, baked().map); }), test.code)
                << call;
            EXPECT_TRUE(device.alive.empty()) << "call " << call << " leaks";
        }
    device.failing_call = -1;
    EXPECT_EQ(thrown_by([&] { const dxr::MapObject object(&device, baked().map); }), ExitCode::ok);
}

TEST_F(DxrMapObject, RefusesWhatCannotWork) {
    const auto load = [&] { const dxr::MapObject object(&device, baked().map); };
    device.tier = D3D12_RAYTRACING_TIER_NOT_SUPPORTED;
    EXPECT_EQ(thrown_by(load), ExitCode::unsupported);
    device.tier = D3D12_RAYTRACING_TIER_1_1;
    EXPECT_EQ(thrown_by(load), ExitCode::ok);
    device.structure_size = 0;
    EXPECT_EQ(thrown_by(load), ExitCode::internal);
    device.structure_size = 1000;
    EXPECT_EQ(thrown_by([&] { const dxr::MapObject object(&device, SphericalMap{}); }), ExitCode::usage);
    dxr::MapObject object(&device, baked().map);
    object.finish();
    EXPECT_EQ(thrown_by([&] { object.record(&commands); }), ExitCode::usage);
    EXPECT_TRUE(commands.commands.empty());
}

TEST_F(DxrMapObject, ErrorsNameTheCallAndItsResult) {
    device.failing_call = 1;
    device.failure = HRESULT(0x80070057U);
    try {
        const dxr::MapObject object(&device, baked().map);
        ADD_FAILURE() << "nothing was thrown";
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "CreateCommittedResource failed with HRESULT 0x80070057");
    }
}

} // namespace
} // namespace spa::test
