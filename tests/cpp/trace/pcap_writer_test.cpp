#include "netsim/trace/pcap_writer.hpp"

#include <csignal>
#include <filesystem>
#include <string>
#include <sys/resource.h>

#include <gtest/gtest.h>

#include "netsim/error.hpp"
#include "support/temporary_file.hpp"

namespace netsim {
namespace {

using test::TemporaryFile;

// Can be opened but not written: a disk that is always full.
constexpr const char* full_disk = "/dev/full";

TEST(PcapWriter, AFileOfOnePacket) {
    const TemporaryFile file;
    PcapWriter writer(file.path(), LinkType::radiotap);
    writer.write(SimTime::from_seconds(2) + SimTime::from_ps(258'999), Octets{0xaa, 0xbb, 0xcc});
    writer.close();
    EXPECT_EQ(file.content(),
              (Octets{0x4d, 0x3c, 0xb2, 0xa1,                          // nanoseconds
                      0x02, 0x00, 0x04, 0x00,                          // version
                      0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,  // unused
                      0x00, 0x00, 0x04, 0x00,                          // longest packet
                      0x7f, 0x00, 0x00, 0x00,                          // radiotap
                      0x02, 0x00, 0x00, 0x00, 0x02, 0x01, 0x00, 0x00,  // 2 s and 258 ns
                      0x03, 0x00, 0x00, 0x00, 0x03, 0x00, 0x00, 0x00,  // three octets, all here
                      0xaa, 0xbb, 0xcc}));
}

TEST(PcapWriter, TheDestructorCompletesTheFile) {
    const TemporaryFile file;
    PcapWriter(file.path(), LinkType::radiotap).write(SimTime{}, Octets(100));
    EXPECT_EQ(file.content().size(), 24U + 16U + 100U);
}

TEST(PcapWriter, AnEarlierFileIsReplaced) {
    const TemporaryFile file;
    PcapWriter(file.path(), LinkType::radiotap).write(SimTime{}, Octets(100));
    PcapWriter(file.path(), LinkType::radiotap).close();
    EXPECT_EQ(file.content().size(), 24U);
}

TEST(PcapWriter, APathThatCannotBeOpenedIsAnError) {
    try {
        PcapWriter writer("no/such/folder/a.pcap", LinkType::radiotap);
        FAIL();
    } catch (const ConfigError& error) {
        EXPECT_EQ(std::string(error.what()),
                  "cannot write the capture file 'no/such/folder/a.pcap': No such file or directory");
    }
}

TEST(PcapWriter, AFullDiskIsAnErrorAtOnce) {
    if (!std::filesystem::exists(full_disk)) {
        GTEST_SKIP() << "there is no " << full_disk;
    }
    EXPECT_THROW(PcapWriter writer(full_disk, LinkType::radiotap), ConfigError);
}

// While it exists, no file of this process grows beyond a limit.
class FileSizeLimit {
public:
    explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;
    ~FileSizeLimit() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

private:
    void (*handler_)(int);
    rlimit before_{};
};

TEST(PcapWriter, WhatDoesNotFitAnyMoreIsReportedInTheEnd) {
    const TemporaryFile file;
    PcapWriter writer(file.path(), LinkType::radiotap);
    const FileSizeLimit limit(1'000'000);
    for (int packet = 0; packet < 20; ++packet) {
        writer.write(SimTime{}, Octets(100'000));
    }
    try {
        writer.close();
        FAIL();
    } catch (const SimulationError& error) {
        EXPECT_EQ(std::string(error.what()), "cannot write the capture file '" + file.path() +
                                                 "': File too large; it lacks the last frames");
    }
}

TEST(PcapWriter, ClosingTwiceIsFine) {
    const TemporaryFile file;
    PcapWriter writer(file.path(), LinkType::radiotap);
    writer.close();
    EXPECT_NO_THROW(writer.close());
}

}  // namespace
}  // namespace netsim
