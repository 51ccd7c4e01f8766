// SPDX-License-Identifier: Apache-2.0
// What the importers open and what they do not: links that leave the asset's folder, what is no regular file,
// files that change, files that are missing.
#include "gltf_builder.h"

#include "../../formats/import/open_file.h"
#include "../../formats/import/source_file.h"
#include "../../libspa/core/error.h"

#include <fstream>

#include <gtest/gtest.h>
#include <sys/stat.h>

namespace spa::test {
namespace {

namespace fs = std::filesystem;

const std::string face = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n";

std::string gltf_with_buffer(const std::string& uri) {
    Json json = triangle().json;
    json["buffers"] = {{{"byteLength", 36}, {"uri", uri}}};
    json["bufferViews"] = {{{"buffer", 0}, {"byteLength", 36}}};
    json["accessors"] = Json::array({json["accessors"][0]});
    json["meshes"][0]["primitives"][0]["attributes"].erase("NORMAL");
    return json.dump();
}

std::string gltf_with_image(const std::string& uri, bool used) {
    GltfBuilder builder = triangle();
    builder.json["images"] = {{{"uri", uri}}};
    builder.json["textures"] = {{{"source", 0}}};
    const char* const texture = used ? "baseColorTexture" : "metallicRoughnessTexture";
    builder.json["materials"] = {{{"pbrMetallicRoughness", {{texture, {{"index", 0}}}}}}};
    Json& primitive = builder.json["meshes"][0]["primitives"][0];
    primitive["material"] = 0;
    primitive["attributes"]["TEXCOORD_0"] =
        builder.add_accessor(std::vector<float>{0, 0, 1, 0, 0, 1}, "VEC2");
    return builder.text();
}

const std::string ply_with_texture = "ply\nformat ascii 1.0\ncomment TextureFile x.tga\nelement vertex 3\n"
                                     "property float x\nproperty float y\nproperty float z\n"
                                     "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                                     "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

// An asset that refers to the file "x.tga", whose content fits.
struct Referring {
    const char* name;
    std::string content;
};

std::vector<Referring> referring_assets() {
    return {{"buffer.gltf", gltf_with_buffer("x.tga")},       {"used.gltf", gltf_with_image("x.tga", true)},
            {"unused.gltf", gltf_with_image("x.tga", false)}, {"library.obj", "mtllib x.tga\n" + face},
            {"texture.obj", "mtllib a.mtl\n" + face},         {"texture.ply", ply_with_texture}};
}

class Files : public testing::Test {
protected:
    Files() {
        folder_.write("inner/a.mtl", "newmtl m\nmap_Kd x.tga\n");
        folder_.write_tga("outside.tga", 4, std::vector<std::array<std::uint8_t, 4>>(16, {9, 9, 9, 255}));
    }

    // The asset, written to the folder "inner".
    [[nodiscard]] fs::path write(const Referring& asset) const {
        return folder_.write("inner/" + std::string(asset.name), asset.content);
    }
    [[nodiscard]] fs::path inner(const std::string& name) const { return folder_.path("inner/" + name); }

    Scratch folder_;
};

TEST_F(Files, LinksOutOfTheFolderAreRefused) {
    import::Limits follow;
    follow.follow_links = true;
    const fs::path outside = folder_.path("outside.tga");
    fs::create_directories(folder_.path("inner/sub"));
    fs::create_symlink("../../outside.tga", inner("sub/relative.tga"));
    for (const fs::path& target : {outside, fs::path("../outside.tga"), fs::path("sub/relative.tga")}) {
        fs::remove(inner("x.tga"));
        fs::create_symlink(target, inner("x.tga"));
        for (const Referring& asset : referring_assets()) {
            const fs::path path = write(asset);
            const std::string message = refusal_of(path);
            EXPECT_NE(message.find("'x.tga'"), std::string::npos) << message;
            EXPECT_NE(message.find("--follow-links"), std::string::npos) << message;
            EXPECT_NO_THROW(expect_valid(import::read_model(path, follow))) << path;
        }
    }
}

TEST_F(Files, SoAreFoldersThatAreLinks) {
    fs::create_directories(folder_.path("elsewhere"));
    fs::copy(folder_.path("outside.tga"), folder_.path("elsewhere/x.tga"));
    fs::create_directory_symlink("../elsewhere", inner("sub"));
    const std::string message = refusal_of(write({"a.gltf", gltf_with_image("sub/x.tga", true)}));
    EXPECT_NE(message.find("--follow-links"), std::string::npos) << message;
    // A folder whose name begins as that of the asset's folder is another folder.
    fs::rename(folder_.path("elsewhere"), folder_.path("inner2"));
    fs::remove(inner("sub"));
    fs::create_directory_symlink("../inner2", inner("sub"));
    EXPECT_NE(refusal_of(inner("a.gltf")).find("--follow-links"), std::string::npos);
}

TEST_F(Files, LinksInsideTheFolderAndTheAssetItselfAreFollowed) {
    fs::create_directories(inner("maps"));
    fs::copy(folder_.path("outside.tga"), inner("maps/real.tga"));
    fs::create_symlink("maps/real.tga", inner("x.tga"));
    fs::create_directory_symlink("inner", folder_.path("other"));
    fs::create_directories(folder_.path("named"));
    fs::copy(folder_.path("outside.tga"), folder_.path("named/x.tga"));
    for (const Referring& asset : referring_assets()) {
        const fs::path path = write(asset);
        EXPECT_NO_THROW(expect_valid(import::read_model(path))) << path;
        EXPECT_NO_THROW(expect_valid(import::read_model(folder_.path("other") / asset.name))) << path;
        // References are looked for beside the link, not beside the file that it leads to.
        if (asset.name == std::string("texture.obj")) continue; // a.mtl is not there
        const fs::path link = folder_.path("named") / asset.name;
        fs::create_symlink(path, link);
        fs::remove(inner("x.tga"));
        EXPECT_NO_THROW(expect_valid(import::read_model(link))) << link;
        fs::create_symlink("maps/real.tga", inner("x.tga"));
    }
}

TEST_F(Files, RelativePathsOfAssets) {
    const fs::path before = fs::current_path();
    fs::copy(folder_.path("outside.tga"), inner("x.tga"));
    for (const Referring& asset : referring_assets()) (void)write(asset);
    fs::current_path(folder_.path("inner"));
    for (const Referring& asset : referring_assets()) EXPECT_NO_THROW((void)import::read_model(asset.name));
    fs::remove("x.tga");
    fs::create_symlink("../outside.tga", "x.tga");
    for (const Referring& asset : referring_assets())
        EXPECT_THROW((void)import::read_model(asset.name), Error);
    fs::current_path(before);
}

// Opening a pipe that nobody writes to waits for ever, reading /dev/zero never ends.
TEST_F(Files, WhatIsNoRegularFileIsNotRead) {
    const auto expect_refused = [](const fs::path& path) {
        try {
            (void)import::read_model(path);
            ADD_FAILURE() << path;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::input_output);
            EXPECT_NE(std::string(error.what()).find("not a regular file"), std::string::npos)
                << error.what();
        }
    };
    const auto try_all = [&] {
        for (const Referring& asset : referring_assets()) {
            const fs::path path = write(asset);
            if (asset.name == std::string("unused.gltf"))
                EXPECT_TRUE(has_warning(import::read_model(path).report, "not a regular file"));
            else
                expect_refused(path);
        }
    };
    ASSERT_EQ(::mkfifo(inner("x.tga").c_str(), 0600), 0);
    expect_refused(inner("x.tga"));
    try_all();
    fs::remove(inner("x.tga"));
    fs::create_directory(inner("x.tga"));
    expect_refused(inner("x.tga"));
    try_all();
    expect_refused("/dev/zero");
}

TEST_F(Files, AFileThatChangesWhileItIsReadIsAnError) {
    const fs::path path = folder_.write("a.obj", face);
    const auto expect_changed = [&](const auto& change) {
        const std::optional<import::OpenFile> file = import::OpenFile::open(path);
        ASSERT_TRUE(file.has_value());
        change();
        try {
            (void)file->read(import::whole_file);
            ADD_FAILURE();
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::input_output);
            EXPECT_EQ(std::string(error.what()), path.string() + ": changed while it was read; try again");
        }
    };
    expect_changed([&] { std::ofstream(path, std::ios::app) << "#"; });
    expect_changed([&] { fs::resize_file(path, 3); });
    expect_changed(
        [&] { fs::last_write_time(path, fs::file_time_type::clock::now() - std::chrono::hours(1)); });
    const std::optional<import::OpenFile> unchanged = import::OpenFile::open(path);
    EXPECT_EQ(unchanged->read(import::whole_file).size(), 3U);
    EXPECT_EQ(unchanged->read(2).size(), 2U);
}

TEST_F(Files, TheStateOfEachSource) {
    fs::copy(folder_.path("outside.tga"), inner("x.tga"));
    const import::Result result = import::read_model(write({"a.obj", "mtllib a.mtl\n" + face}));
    ASSERT_EQ(result.report.files.size(), 3U);
    for (const import::SourceFile& file : result.report.files) {
        struct stat info {};
        ASSERT_EQ(::stat(inner(file.name).c_str(), &info), 0);
        EXPECT_EQ(file.state.device, info.st_dev);
        EXPECT_EQ(file.state.inode, info.st_ino);
        EXPECT_EQ(file.state.size, std::uint64_t(info.st_size));
        EXPECT_EQ(file.state.mtime_ns, info.st_mtim.tv_sec * 1'000'000'000 + info.st_mtim.tv_nsec);
        EXPECT_EQ(file.state.ctime_ns, info.st_ctim.tv_sec * 1'000'000'000 + info.st_ctim.tv_nsec);
        EXPECT_EQ(file.bytes, file.state.size);
    }
}

TEST_F(Files, WhatWasMissing) {
    using Names = std::vector<std::string>;
    const auto missing = [&](const Referring& asset) {
        return import::read_model(write(asset)).report.missing;
    };
    EXPECT_EQ(missing({"a.gltf", gltf_with_image("sub/.%2Fx%20y.png", false)}), Names{"sub/x y.png"});
    EXPECT_EQ(missing({"b.obj", "mtllib none.mtl\nmtllib none.mtl\n" + face}), Names{"none.mtl"});
    EXPECT_EQ(missing({"c.ply", ply_with_texture}), Names{"x.tga"});
    // All places that are looked at.
    folder_.write("inner/maps/m.mtl", "newmtl m\nmap_Kd gone.png\nmap_d gone.png\n");
    EXPECT_EQ(missing({"d.obj", "mtllib maps/m.mtl\n" + face}), (Names{"gone.png", "maps/gone.png"}));
    EXPECT_EQ(missing({"e.obj", "mtllib a.mtl maps/m.mtl\n" + face}), (Names{"a.mtl maps/m.mtl", "x.tga"}));
    folder_.write_tga("inner/X.TGA", 1, {{9, 9, 9, 255}});
    // a.mtl and X.TGA will do, but files of the very names would do better.
    EXPECT_EQ(missing({"f.obj", "mtllib A.mtl\n" + face}), (Names{"A.mtl", "x.tga"}));
}

} // namespace
} // namespace spa::test
