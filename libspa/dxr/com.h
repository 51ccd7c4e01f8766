// SPDX-License-Identifier: Apache-2.0
// References to COM objects, and their results as exceptions.
#pragma once

#include "d3d12.h"

#include <utility>

namespace spa::dxr {

// One reference to an object, released at the end.
template <class T>
class Com {
public:
    Com() = default;
    // Takes the reference over.
    explicit Com(T* object) : object_(object) {}
    ~Com() { reset(); }
    Com(Com&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
    Com& operator=(Com&& other) noexcept {
        if (this != &other) {
            reset();
            object_ = std::exchange(other.object_, nullptr);
        }
        return *this;
    }

    [[nodiscard]] T* get() const { return object_; }
    T* operator->() const { return object_; }
    void reset() {
        if (T* object = std::exchange(object_, nullptr)) object->Release();
    }

private:
    T* object_ = nullptr;
};

// Throws Error unless the call succeeded: unsupported where memory ran out or the device is gone, else
// internal. what: the function that was called.
void check(HRESULT result, const char* what);

} // namespace spa::dxr
