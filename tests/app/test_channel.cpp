// Messages between two processes. Oracle: what was sent.
#include "app/live/channel.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <thread>

namespace test_channel {
using namespace dynlab;

TEST(channel, carries_messages_of_any_length) {
    auto [here, there] = Channel::pair();
    const std::string large(3'000'000, 'x');
    std::thread sender([&there = there, &large] {
        there.send("");
        there.send(large);
        there.send(std::string("a\0b", 3));
    });
    EXPECT_EQ(here.receive()->bytes, "");
    EXPECT_EQ(here.receive()->bytes, large);
    EXPECT_EQ(here.receive()->bytes, std::string("a\0b", 3));
    sender.join();
}

TEST(channel, carries_open_files) {
    auto [here, there] = Channel::pair();
    auto [inner_here, inner_there] = Channel::pair();
    ASSERT_TRUE(there.send("with a line", inner_there.descriptor()));
    inner_there = Channel(FileDescriptor());
    auto message = here.receive();
    ASSERT_TRUE(message);
    Channel received(std::move(message->file));
    ASSERT_TRUE(received.send("through it"));
    EXPECT_EQ(inner_here.receive()->bytes, "through it");
}

TEST(channel, reports_that_the_other_side_is_gone) {
    auto [here, there] = Channel::pair();
    there = Channel(FileDescriptor());
    EXPECT_FALSE(here.receive());
    EXPECT_FALSE(here.send("anybody?"));
}

/// A side that dies in the middle of a message.
TEST(channel, half_a_message_is_none) {
    auto [here, there] = Channel::pair();
    const std::uint64_t length = 100;
    ASSERT_EQ(::write(there.descriptor(), &length, sizeof length), static_cast<ssize_t>(sizeof length));
    ASSERT_EQ(::write(there.descriptor(), "half", 4), 4);
    there = Channel(FileDescriptor());
    EXPECT_FALSE(here.receive());
}

}  // namespace test_channel
