#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <mutex>
#include <thread>
#include <vector>

namespace esi {

/// Threads that run tasks in the order in which they were given. Whoever waits for a task can lend a hand, so
/// that n - 1 workers keep n cores busy. Without workers a task runs within submit().
/// submit() and help() belong to the thread that owns the pool.
class WorkerPool {
 public:
  /// Where the system gives fewer threads than asked for, the pool has fewer workers.
  explicit WorkerPool(int workers);
  /// Waits for the tasks that run; those not yet begun are dropped (their futures break).
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  std::size_t workers() const { return threads_.size(); }

  /// The future rethrows what the task threw.
  std::future<void> submit(std::function<void()> task);

  /// Runs the oldest waiting task in the calling thread. False when none waits.
  bool help();

  /// Helps until `task` is done, then waits for it. Rethrows what it threw.
  void finish(std::future<void> task);

 private:
  void work();

  std::mutex mutex_;
  std::condition_variable task_or_end_;
  std::deque<std::packaged_task<void()>> waiting_;
  bool ending_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace esi
