// SPDX-License-Identifier: Apache-2.0
// Uses the installed Direct3D loader as far as it goes without a device.
#include <libspa/core/error.h>
#include <libspa/dxr/hit_group.h>
#include <libspa/dxr/map_object.h>

int main() {
    const spa::dxr::LocalRootSignature local;
    if (local.description().NumParameters != 2) return 1;
    try {
        const spa::dxr::MapObject object(nullptr, spa::SphericalMap{});
        return 2;
    } catch (const spa::Error& error) {
        return error.code() == spa::ExitCode::usage ? 0 : 3; // there is no part
    }
}
