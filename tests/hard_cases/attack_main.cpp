// SPDX-License-Identifier: Apache-2.0
// attack RAYS [JUDGE_EVERY [SEED [THREADS]]]: so many hard rays of each class, shared among the maps; every
// JUDGE_EVERY-th is judged (1: all of them). Ends with 1 if any answer is wrong.
#include "attack.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <thread>

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fprintf(stderr, "usage: attack RAYS [JUDGE_EVERY [SEED [THREADS]]]\n");
        return 2;
    }
    const auto number = [&](int i, std::uint64_t otherwise) {
        return i < argc ? std::max<std::uint64_t>(1, std::strtoull(argv[i], nullptr, 10)) : otherwise;
    };
    const spa::test::AttackOptions options{
        .rays_per_class = number(1, 1),
        .judge_every = number(2, 1),
        .seed = number(3, 1),
        .threads = unsigned(number(4, std::max(1U, std::thread::hardware_concurrency())))};
    const spa::test::AttackResult result = spa::test::attack(spa::test::attacked_parts(), options);
    print(result);
    return result.total().passed() ? 0 : 1;
}
