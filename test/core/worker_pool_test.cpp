#include "esi/core/worker_pool.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <stdexcept>
#include <string>

using esi::WorkerPool;

TEST_CASE("Every task runs once, for any number of workers") {
  const int workers = GENERATE(0, 1, 3);
  WorkerPool pool(workers);
  REQUIRE(pool.workers() == static_cast<std::size_t>(workers));
  constexpr int tasks = 500;
  std::vector<int> runs(tasks, 0);  // not atomic: the futures must order the accesses
  std::vector<std::future<void>> done;
  done.reserve(tasks);
  for (int i = 0; i < tasks; ++i) {
    done.push_back(pool.submit([&runs, i] { ++runs[static_cast<std::size_t>(i)]; }));
  }
  for (std::future<void>& task : done) pool.finish(std::move(task));
  CHECK(runs == std::vector<int>(tasks, 1));
}

TEST_CASE("Without workers a task runs within submit, and its error waits in the future") {
  WorkerPool pool(0);
  std::thread::id ran_in;
  pool.submit([&] { ran_in = std::this_thread::get_id(); });
  CHECK(ran_in == std::this_thread::get_id());
  auto failing = pool.submit([] { throw std::runtime_error("full"); });
  CHECK_THROWS_WITH(pool.finish(std::move(failing)), "full");
}

TEST_CASE("The error of a task is rethrown to the one who waits for it, and the workers live on") {
  WorkerPool pool(2);
  std::vector<std::future<void>> done;
  done.reserve(20);
  for (int i = 0; i < 20; ++i) {
    done.push_back(pool.submit([i] {
      if (i % 2 == 1) throw std::runtime_error("task " + std::to_string(i));
    }));
  }
  for (std::size_t i = 0; i < done.size(); ++i) {
    if (i % 2 == 0) {
      CHECK_NOTHROW(pool.finish(std::move(done[i])));
    } else {
      CHECK_THROWS_WITH(pool.finish(std::move(done[i])), "task " + std::to_string(i));
    }
  }
}

TEST_CASE("Who waits runs the tasks that no worker has taken, oldest first") {
  WorkerPool pool(1);
  std::promise<void> begun, release;
  auto busy = pool.submit([&] {
    begun.set_value();
    release.get_future().wait();
  });
  begun.get_future().wait();
  std::string order;
  std::thread::id ran_in;
  auto first = pool.submit([&] { order += "a", ran_in = std::this_thread::get_id(); });
  auto second = pool.submit([&] { order += "b"; });
  pool.finish(std::move(second));  // would hang if it waited for the worker
  CHECK(order == "ab");
  CHECK(ran_in == std::this_thread::get_id());
  CHECK_FALSE(pool.help());
  release.set_value();
  pool.finish(std::move(busy));
  CHECK_NOTHROW(first.get());
}

TEST_CASE("A pool that ends waits for what runs and drops what has not begun") {
  std::atomic<bool> running_ended = false;
  std::future<void> running, dropped;
  bool dropped_ran = false;
  {
    WorkerPool pool(1);
    std::promise<void> begun;
    running = pool.submit([&] {
      begun.set_value();
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      running_ended = true;
    });
    begun.get_future().wait();
    dropped = pool.submit([&] { dropped_ran = true; });
  }
  CHECK(running_ended);
  CHECK_NOTHROW(running.get());
  CHECK_FALSE(dropped_ran);
  CHECK_THROWS_AS(dropped.get(), std::future_error);
}
