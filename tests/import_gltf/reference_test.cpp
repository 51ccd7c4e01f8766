// SPDX-License-Identifier: Apache-2.0
// References stay inside the asset's folder.
#include "gltf_builder.h"

#include "../../formats/import/data_uri.h"
#include "../../formats/import/source_file.h"
#include "../../libspa/core/error.h"

#include <gtest/gtest.h>

namespace spa::test {
namespace {

using import::Encoding;
using import::resolve_reference;

TEST(Reference, Inside) {
    const auto name = [](const char* text, Encoding encoding = Encoding::uri) {
        return resolve_reference("/a/b.gltf", text, encoding).name;
    };
    EXPECT_EQ(name("x.png"), "x.png");
    EXPECT_EQ(name("./maps//x.png"), "maps/x.png");
    EXPECT_EQ(name("maps/../x.png"), "x.png");
    EXPECT_EQ(name("my%20map%2Epng"), "my map.png");
    EXPECT_EQ(name("maps\\x.png"), "maps/x.png");
    EXPECT_EQ(name("100%.png"), "100%.png");
    EXPECT_EQ(name("a%20b.png", Encoding::file_name), "a%20b.png");
    EXPECT_EQ(resolve_reference("/a/b.gltf", "c/x.png", Encoding::uri).path, "/a/c/x.png");
    EXPECT_EQ(resolve_reference("b.gltf", "x.png", Encoding::uri).path, "x.png");
}

TEST(Reference, Outside) {
    for (const char* text :
         {"", ".", "/etc/passwd", "\\\\server\\x", "../x.png", "a/../../x.png", "%2e%2e/x.png", "..%2Fx.png",
          "..\\x.png", "%2Fetc/passwd", "C:/x.png", "c:\\x.png", "http://h/x.png", "file:///x.png",
          "%66ile:///x.png", "ftp:x", "a%00b.png", "a\nb.png", "a/.."}) {
        for (const Encoding encoding : {Encoding::uri, Encoding::file_name}) {
            if (encoding == Encoding::file_name && std::string_view(text).find('%') != std::string_view::npos)
                continue;
            try {
                const import::Reference reference = resolve_reference("/a/b.gltf", text, encoding);
                ADD_FAILURE() << text << " led to " << reference.path;
            } catch (const Error& error) {
                EXPECT_EQ(error.code(), ExitCode::invalid_data);
                EXPECT_EQ(std::string_view(error.what()).rfind("/a/b.gltf: ", 0), 0U);
            }
        }
    }
}

TEST(Reference, EscapesInAFileAreRefused) {
    const Scratch scratch;
    scratch.write("secret.bin", std::string(36, '\0'));
    for (const char* uri : {"../secret.bin", "sub/../../secret.bin", "%2e%2e/secret.bin", "/etc/passwd",
                            "file:///etc/passwd", "https://example.org/a.bin"}) {
        GltfBuilder builder = triangle();
        builder.json["buffers"] = {{{"byteLength", 72}, {"uri", uri}}};
        EXPECT_NE(scratch.refusal("inner/a.gltf", builder.text()).find("stay inside"), std::string::npos)
            << uri;
        builder = triangle();
        builder.json["images"] = {{{"uri", uri}}};
        EXPECT_NE(scratch.refusal("inner/a.gltf", builder.text()).find("stay inside"), std::string::npos)
            << uri;
    }
}

TEST(Reference, BufferFiles) {
    const Scratch scratch;
    const std::vector<float> values{0, 0, 0, 1, 0, 0, 0, 1, 0};
    const std::string bytes(reinterpret_cast<const char*>(values.data()), 36);
    scratch.write("my buffer.bin", bytes + "more than is asked for");
    Json json = triangle().json;
    json["buffers"] = {{{"byteLength", 36}, {"uri", "my%20buffer.bin"}}};
    json["bufferViews"] = {{{"buffer", 0}, {"byteLength", 36}}};
    json["accessors"] = Json::array({json["accessors"][0]});
    json["meshes"][0]["primitives"][0]["attributes"].erase("NORMAL");
    const import::Result result = scratch.read("a.gltf", json.dump());
    ASSERT_EQ(result.report.files.size(), 2U);
    EXPECT_EQ(result.report.files[0].name, "a.gltf");
    EXPECT_EQ(result.report.files[1].name, "my buffer.bin");
    EXPECT_EQ(result.report.files[1].bytes, 58U);

    scratch.write("my buffer.bin", bytes.substr(1));
    EXPECT_NE(
        scratch.refusal("a.gltf", json.dump()).find("buffers[0].byteLength: is 36, but there are only 35"),
        std::string::npos);
    json["buffers"][0]["uri"] = "none.bin";
    EXPECT_NE(scratch.refusal("a.gltf", json.dump()).find("the file 'none.bin' does not exist"),
              std::string::npos);
}

TEST(Reference, Base64) {
    const auto text = [](const char* encoded) {
        const auto bytes = import::decode_base64(encoded);
        if (!bytes) return std::string("refused");
        return std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    };
    EXPECT_EQ(text(""), ""); // RFC 4648, 10
    EXPECT_EQ(text("Zg=="), "f");
    EXPECT_EQ(text("Zm8="), "fo");
    EXPECT_EQ(text("Zm9v"), "foo");
    EXPECT_EQ(text("Zm9vYg"), "foob");
    EXPECT_EQ(text("Zm9vYmFy"), "foobar");
    for (const char* wrong : {"Z", "Zm9vY", "Zm 9v", "Zm9v=Yg=", "Zm9\xFF", "===="})
        EXPECT_EQ(text(wrong), "refused") << wrong;
    EXPECT_FALSE(import::decode_data_uri("data:"));
    EXPECT_FALSE(import::decode_data_uri("data:image/png;base64"));
    EXPECT_EQ(import::decode_data_uri("data:text/plain,a%20b")->size(), 3U);
    EXPECT_EQ(import::decode_data_uri("data:;base64,Zm9v")->size(), 3U);
}

} // namespace
} // namespace spa::test
