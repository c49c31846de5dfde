// esi-sweep under mpirun. Only built with ESI_WITH_MPI.
#include <catch2/catch.hpp>

#include "apps/sweep_command.hpp"

using namespace esi::test;
using Catch::Matchers::Contains;

namespace {

/// "-n 2", or several programs as mpirun takes them.
std::string mpirun(const std::string& what) {
  return "timeout 120 " ESI_MPIEXEC " --allow-run-as-root --oversubscribe " + what;
}

std::string esi_sweep() { return " " + quoted(tool("esi-sweep")) + " "; }

}  // namespace

TEST_CASE("two and three ranks give the bytes of one process") {
  const TempFolder folder;
  const std::string search = GENERATE("", "--search halving --first-stride 4");
  const std::string arguments = small_sweep() + search;
  REQUIRE(sweep(folder / "one", arguments + " --threads 1").exit_code == 0);
  for (const std::string ranks : {"1", "2", "3"}) {
    const auto result =
        run_shell(mpirun("-n " + ranks) + esi_sweep() + arguments + " -o " + quoted(folder / ranks));
    CAPTURE(ranks, result.err);
    CHECK(result.exit_code == 0);
    CHECK(digest_of_sweep(folder / ranks) == digest_of_sweep(folder / "one"));
  }
}

TEST_CASE("a rank is killed; the same command goes on") {
  const TempFolder folder;
  const std::string more = small_sweep() + "--grid clamp=1:3:0.25 ";
  const std::string arguments = more + "-o " + quoted(folder / "out");
  const std::string rank = GENERATE("0", "1");
  // The rank kills itself when something is in the store.
  const std::string script = "if [ $OMPI_COMM_WORLD_RANK = " + rank + " ]; then self=$$; (until [ $(cat " +
                             quoted(folder / "out" / "cells.jsonl") +
                             " 2>/dev/null | wc -l) -ge 2 ]; do sleep 0.02; done; kill -9 $self) & fi; exec" +
                             esi_sweep() + arguments;
  const auto killed = run_shell(mpirun("-n 3 bash -c ") + quoted(script));
  CAPTURE(killed.err);
  CHECK(killed.exit_code == 137);
  CHECK_FALSE(std::filesystem::exists(folder / "out" / "run.json"));
  const std::vector<std::string> kept = lines_of(folder / "out" / "cells.jsonl");
  CHECK(kept.size() >= 2);
  CHECK(run_shell(mpirun("-n 3") + esi_sweep() + arguments).exit_code == 0);
  REQUIRE(sweep(folder / "one", more).exit_code == 0);
  CHECK(digest_of_sweep(folder / "out") == digest_of_sweep(folder / "one"));
}

TEST_CASE("what goes wrong is said once, by whichever rank, and ends them all") {
  const TempFolder folder;
  const auto told_once = [](const ToolResult& result, int code, const std::string& what) {
    CAPTURE(result.err);
    CHECK(result.exit_code == code);
    const std::size_t first = result.err.find("esi-sweep: ");
    REQUIRE(first != std::string::npos);
    CHECK(result.err.find("esi-sweep: ", first + 1) == std::string::npos);
    CHECK_THAT(result.err, Contains(what));
  };
  const std::string out = " -o " + quoted(folder / "out");
  told_once(run_shell(mpirun("-n 3") + esi_sweep() + small_sweep() + "--bogus" + out), 2, "--bogus");
  told_once(run_shell(mpirun("-n 3") + esi_sweep() + small_sweep() + "-o /proc/nothing"), 1, "/proc/nothing");
  // One rank alone can't begin; one has another grid; the leader's disk is full.
  told_once(run_shell(mpirun("-n 1") + esi_sweep() + small_sweep() + out + " : -n 1" + esi_sweep() +
                      "absent.h5 -g " + quoted(source_dir() / "data-samples/flight/ground_truth.json") + out),
            1, "absent.h5");
  told_once(run_shell(mpirun("-n 1") + esi_sweep() + small_sweep() + out + " : -n 1" + esi_sweep() +
                      small_sweep() + "--grid clamp=1,2,4" + out),
            1, "another sweep");
  // Sockets and shared memory have no use for files here: only the store meets the limit.
  const std::string limited = "[ $OMPI_COMM_WORLD_RANK != 0 ] || ulimit -f 3; exec" + esi_sweep() +
                              small_sweep() + "-o " + quoted(folder / "full");
  told_once(run_shell(mpirun("--mca btl self,tcp -n 2 bash -c ") + quoted(limited)), 1, "too large");
}

TEST_CASE("under mpirun one rank speaks") {
  const auto version = run_shell(mpirun("-n 3") + esi_sweep() + "--version");
  CHECK(version.exit_code == 0);
  CHECK(version.out.find("esi-sweep") == version.out.rfind("esi-sweep"));
  const auto plan = run_shell(mpirun("-n 2") + esi_sweep() + small_sweep() + "--plan");
  CHECK(plan.exit_code == 0);
  CHECK(plan.out.find("cells: 6") == plan.out.rfind("cells: "));
}
