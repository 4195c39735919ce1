// Parts of work and the machines that do them, as they are written on the command line. Oracle: counting.
#include "workflow/parts/machines.h"

#include <gmock/gmock.h>

#include "platform/error.h"
#include "platform/temporary_folder.h"
#include "workflow/parts/part.h"

namespace dynlab {
namespace test_machines {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(machines, parts_are_written_as_one_of_many) {
    const auto part = part_in("3/8");
    ASSERT_TRUE(part);
    EXPECT_EQ(part->index, 3);
    EXPECT_EQ(part->count, 8);
    EXPECT_EQ(part->text(), "3/8");
    for (const char* wrong : {"", "3", "0/8", "9/8", "-1/8", "3/", "/8", "3/8 ", "a/b", "1/1001"})
        EXPECT_FALSE(part_in(wrong)) << wrong;
}

// oracle: every place is counted once
TEST(machines, the_parts_together_have_everything_once) {
    for (const int count : {1, 2, 7, 40})
        for (std::size_t place = 0; place < 30; ++place) {
            int owners = 0;
            for (int index = 1; index <= count; ++index) owners += WorkPart{index, count}.has(place);
            EXPECT_EQ(owners, 1) << place << " of " << count;
        }
}

TEST(machines, slurm_gets_its_own_options) {
    const Machines machines = machines_in("slurm:tasks=16,partition=short,time=2:00:00,rounds=2");
    EXPECT_EQ(machines.kind, Machines::Kind::kSlurm);
    EXPECT_EQ(machines.parts, 16);
    EXPECT_EQ(machines.rounds, 2);
    EXPECT_THAT(machines.words, ElementsAre("--partition=short", "--time=2:00:00"));
    EXPECT_EQ(machines_in("slurm").parts, 4);
}

TEST(machines, hosts_have_more_parts_than_they_do_at_once) {
    const Machines machines = machines_in("hosts:3/alpha,2/me@beta");
    EXPECT_EQ(machines.kind, Machines::Kind::kHosts);
    EXPECT_EQ(machines.parts, 10);
    EXPECT_THAT(machines.words, ElementsAre("3/alpha", "2/me@beta"));
    EXPECT_THAT(machines_in("processes:4").words, ElementsAre("4/:"));
}

TEST(machines, what_is_no_machine_is_refused_with_what_is_expected) {
    const auto refusal = [](const char* text) -> std::string {
        try {
            machines_in(text);
        } catch (const EnvironmentError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_THAT(refusal("cloud:9"), AllOf(HasSubstr("must be slurm"), HasSubstr("\"cloud:9\" was given")));
    EXPECT_THAT(refusal("processes:0"), HasSubstr("processes:N (1 to 256)"));
    EXPECT_THAT(refusal("hosts:"), HasSubstr("must be slurm"));
    EXPECT_THAT(refusal("hosts:-oProxyCommand=x"), HasSubstr("is not a valid host"));
    EXPECT_THAT(refusal("hosts:a;b"), HasSubstr("is not a valid host"));
    for (const char* wrong : {"slurm:tasks=0", "slurm:tasks=1001", "slurm:tasks", "slurm:rounds=x", "slurm:a b=1"})
        EXPECT_THAT(refusal(wrong), HasSubstr("tasks=N and rounds=N")) << wrong;
}

TEST(machines, the_number_of_parts_is_noted_where_the_parts_are) {
    const TemporaryFolder folder;
    EXPECT_EQ(noted_parts(folder.path() / "parts"), 1);
    note_parts(folder.path() / "parts", 12);
    EXPECT_EQ(noted_parts(folder.path() / "parts"), 12);
}

}  // namespace test_machines
}  // namespace dynlab
