#pragma once
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#include "platform/atomic_file.h"
#include "platform/child_process.h"
#include "platform/program_lookup.h"
#include "platform/temporary_folder.h"

namespace dynlab::test {

/// What a shell says, its errors too.
inline std::string shell_output(const std::string& command) {
    ChildOptions child;
    child.command = {"/bin/bash", "-c", command + " 2>&1"};
    child.timeout = std::chrono::seconds(60);
    return run_child(child, "bash").output;
}

/// A program of an engine, which ends with this object.
class Daemon {
  public:
    explicit Daemon(std::vector<std::string> command) : command_(std::move(command)) { start(); }
    void start() {
        ChildOptions child;
        child.command = command_;
        process_ = std::make_unique<ChildProcess>(child, "dynlab");
    }
    bool ended() const { return process_->ended(); }

  private:
    std::vector<std::string> command_;
    std::unique_ptr<ChildProcess> process_;
};

inline std::string lacking_program(const std::vector<std::string>& programs) {
    if (::geteuid() != 0) return "only root may start these programs";
    for (const std::string& program : programs)
        if (!find_program(program)) return program + " is not installed";
    return "";
}

/// Two hosts, n1 and n2: this machine behind a separate sshd on a high port, with a separate key. On the host `closed`,
/// no server listens.
class LoopbackHosts {
  public:
    LoopbackHosts() : reason_(lacking_program({"/usr/sbin/sshd", "ssh", "ssh-keygen", "parallel"})) {
        if (!reason_.empty()) return;
        const std::string place = folder_.path().string();
        shell_output(
            fmt::format("cd {} && ssh-keygen -q -t ed25519 -N '' -f host && ssh-keygen -q -t ed25519 -N '' -f "
                        "user && mkdir -p /run/sshd",
                        place));
        write_file_atomically(folder_.path() / "sshd",
                              fmt::format("Port 22022\nListenAddress 127.0.0.1\nHostKey {0}/host\n"
                                          "AuthorizedKeysFile {0}/user.pub\nStrictModes no\n"
                                          "PidFile {0}/pid\nUsePAM no\nMaxStartups 100\n",
                                          place));
        write_file_atomically(
            folder_.path() / "ssh",
            fmt::format("Host n1 n2\n  Port 22022\nHost closed\n  Port 22023\nHost *\n  HostName 127.0.0.1\n  "
                        "IdentityFile {0}/user\n  UserKnownHostsFile {0}/known\n  StrictHostKeyChecking no\n  "
                        "BatchMode yes\n  LogLevel ERROR\n",
                        place));
        daemon_ = std::make_unique<Daemon>(
            std::vector<std::string>{"/usr/sbin/sshd", "-D", "-f", place + "/sshd", "-E", place + "/log"});
        for (int i = 0; i < 100 && !answers(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(100));
        if (!answers()) reason_ = "sshd does not answer: " + shell_output("cat " + place + "/log");
    }
    const std::string& reason_to_skip() const { return reason_; }
    /// Environment variables for a shell command. GNU parallel keeps its notes in a separate home folder.
    std::string environment() const {
        return fmt::format("PARALLEL_SSH='ssh -F {0}/ssh' PARALLEL_HOME={0}/parallel", folder_.path().string());
    }
    /// Its sessions, or itself, were killed.
    void restart_what_ended() {
        if (daemon_->ended()) daemon_->start();
    }
    std::string pids() const { return shell_output("pgrep -f " + folder_.path().string() + "/sshd"); }

  private:
    bool answers() const { return shell_output("ssh -F " + folder_.path().string() + "/ssh n1 echo here") == "here\n"; }
    TemporaryFolder folder_;
    std::string reason_;
    std::unique_ptr<Daemon> daemon_;
};

/// A Slurm of two nodes, n1 and n2, both this machine; without munge, systemd and cgroups.
class LoopbackSlurm {
  public:
    LoopbackSlurm() : reason_(lacking_program({"slurmctld", "slurmd", "sbatch"})) {
        if (!reason_.empty()) return;
        const std::string host = shell_output("printf %s \"$(hostname)\"");
        std::string nodes;
        for (int k = 1; k <= 2; ++k)
            nodes += fmt::format(
                "NodeName=n{0} NodeHostname={1} NodeAddr=127.0.0.1 Port=1700{0} CPUs=2 RealMemory=8000\n", k, host);
        write_file_atomically(
            file(),
            fmt::format("ClusterName=dynlab\nSlurmctldHost={0}(127.0.0.1)\nSlurmctldPort=17000\nAuthType=auth/none\n"
                        "CredType=cred/none\nProctrackType=proctrack/linuxproc\nTaskPlugin=task/none\n"
                        "SwitchType=switch/none\nMpiDefault=none\nJobAcctGatherType=jobacct_gather/none\n"
                        "AccountingStorageType=accounting_storage/none\nSelectType=select/cons_tres\n"
                        "SelectTypeParameters=CR_CPU\nSlurmdParameters=config_overrides\nReturnToService=2\n"
                        "SlurmUser=root\nSlurmdUser=root\nSlurmdTimeout=10\nStateSaveLocation={1}/state\n"
                        "SlurmdSpoolDir={1}/spool-%n\nSlurmctldPidFile={1}/pid\nSlurmdPidFile={1}/pid-%n\n"
                        "SlurmctldLogFile={1}/log\nSlurmdLogFile={1}/log-%n\n{2}"
                        "PartitionName=short Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP\n",
                        host, folder_.path().string(), nodes));
        write_file_atomically(folder_.path() / "cgroup.conf", "CgroupPlugin=cgroup/v1\n");
        std::filesystem::create_directories(folder_.path() / "state");
        controller_ =
            std::make_unique<Daemon>(std::vector<std::string>{"slurmctld", "-D", "-c", "-f", file().string()});
        for (const char* node : {"n1", "n2"})
            nodes_.push_back(
                std::make_unique<Daemon>(std::vector<std::string>{"slurmd", "-D", "-N", node, "-f", file().string()}));
        for (int i = 0; i < 200 && !idle(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(100));
        if (!idle()) reason_ = "Slurm does not start: " + shell_output("tail -5 " + folder_.path().string() + "/log*");
    }
    const std::string& reason_to_skip() const { return reason_; }
    std::string environment() const { return "SLURM_CONF=" + file().string(); }
    void end_controller() { controller_.reset(); }
    void restart_what_ended() {
        for (const auto& node : nodes_)
            if (node->ended()) node->start();
    }
    std::string pids() const { return shell_output("pgrep -f 'slurmd -D -N .*" + folder_.path().string() + "'"); }

  private:
    std::filesystem::path file() const { return folder_.path() / "slurm.conf"; }
    bool idle() const { return shell_output(environment() + " sinfo --noheader --Node --format=%T") == "idle\nidle\n"; }
    TemporaryFolder folder_;
    std::string reason_;
    std::unique_ptr<Daemon> controller_;
    std::vector<std::unique_ptr<Daemon>> nodes_;
};

}  // namespace dynlab::test
