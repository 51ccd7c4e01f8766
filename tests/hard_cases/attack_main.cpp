// SPDX-License-Identifier: Apache-2.0
// attack RAYS [SEED [THREADS]]: so many hard rays of each class, shared among the maps; every one is judged.
// Ends with 1 if any answer is wrong.
#include "attack.h"

#include <cstdio>
#include <cstdlib>
#include <thread>

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fprintf(stderr, "usage: attack RAYS [SEED [THREADS]]\n");
        return 2;
    }
    const std::uint64_t rays = std::strtoull(argv[1], nullptr, 10);
    const std::uint64_t seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
    const unsigned threads = argc > 3 ? unsigned(std::strtoul(argv[3], nullptr, 10))
                                      : std::max(1U, std::thread::hardware_concurrency());
    const spa::test::AttackResult result =
        spa::test::attack(spa::test::attacked_parts(), rays, seed, std::max(threads, 1U));
    print(result);
    return result.total().passed() ? 0 : 1;
}
