// SPDX-License-Identifier: Apache-2.0
// Loads a glTF asset as a program without a bake would: tinygltf for the scene and its buffers, OpenImageIO
// for the pixels of its textures. The measure that tools/compare_load.sh holds `spa bake` against.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstdio>
#include <fstream> // tiny_gltf.h lacks it
#include <memory>
#include <string>
#include <vector>

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>

namespace {

bool decode(tinygltf::Image* image, int, std::string* error, std::string*, int, int,
            const unsigned char* bytes, int size, void*) {
    const bool png = size > 0 && bytes[0] == 0x89;
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(png ? "png" : "jpeg");
    OIIO::Filesystem::IOMemReader memory(const_cast<unsigned char*>(bytes), std::size_t(size));
    OIIO::Filesystem::IOProxy* proxy = &memory;
    OIIO::ImageSpec spec, config;
    config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, static_cast<const void*>(&proxy));
    if (!input || !input->open(png ? "memory.png" : "memory.jpeg", spec, config)) {
        *error += "cannot decode an image\n";
        return false;
    }
    image->width = spec.width;
    image->height = spec.height;
    image->component = spec.nchannels;
    image->image.resize(std::size_t(spec.width) * std::size_t(spec.height) * std::size_t(spec.nchannels));
    return input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, image->image.data());
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: load_reference ASSET.gltf|ASSET.glb\n");
        return 1;
    }
    const std::string path = argv[1];
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(decode, nullptr);
    tinygltf::Model model;
    std::string errors, warnings;
    const bool binary = path.size() > 4 && path.compare(path.size() - 4, 4, ".glb") == 0;
    const bool ok = binary ? loader.LoadBinaryFromFile(&model, &errors, &warnings, path)
                           : loader.LoadASCIIFromFile(&model, &errors, &warnings, path);
    std::fputs(errors.c_str(), stderr);
    return ok ? 0 : 3;
}
