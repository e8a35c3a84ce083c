#include <array>
#include <catch2/catch.hpp>
#include <thread>

#include "host_link/mailbox.h"

using quadrig::host::Mailbox;

TEST_CASE("An empty mailbox gives nothing, a full one its newest value once") {
    Mailbox<int> mailbox;
    int value = -1;
    CHECK_FALSE(mailbox.take(value));
    CHECK(value == -1);
    mailbox.publish(1);
    mailbox.publish(2);
    CHECK(mailbox.take(value));
    CHECK(value == 2);
    CHECK_FALSE(mailbox.take(value));
    mailbox.publish(3);
    CHECK(mailbox.take(value));
    CHECK(value == 3);
}

TEST_CASE(
    "Across threads every value taken is whole, never older than the one before, and the last is the last published") {
    struct Big {
        std::array<std::uint64_t, 64> numbers{};
    };
    constexpr std::uint64_t kLast = 200000;
    Mailbox<Big> mailbox;
    std::thread producer([&] {
        Big big;
        for (std::uint64_t n = 1; n <= kLast; ++n) {
            big.numbers.fill(n);
            mailbox.publish(big);
        }
    });
    Big big;
    std::uint64_t newest = 0, torn = 0, backwards = 0, taken = 0;
    while (newest != kLast) {
        if (!mailbox.take(big)) continue;
        ++taken;
        for (const auto n : big.numbers) torn += n != big.numbers[0] ? 1U : 0U;
        backwards += big.numbers[0] <= newest ? 1U : 0U;
        newest = big.numbers[0];
    }
    producer.join();
    CHECK(torn == 0);
    CHECK(backwards == 0);
    CHECK(taken > 0);
}
