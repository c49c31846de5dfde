#include "esi/core/worker_pool.hpp"

#include <chrono>
#include <system_error>
#include <utility>

namespace esi {

WorkerPool::WorkerPool(int workers) {
  try {
    for (int i = 0; i < workers; ++i) threads_.emplace_back([this] { work(); });
  } catch (const std::system_error&) {
    // A limit on threads: fewer workers, or none, do the same work.
    return;
  }
}

WorkerPool::~WorkerPool() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  task_or_end_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

std::future<void> WorkerPool::submit(std::function<void()> task) {
  std::packaged_task<void()> packaged(std::move(task));
  std::future<void> result = packaged.get_future();
  if (threads_.empty()) {
    packaged();
    return result;
  }
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(packaged));
  }
  task_or_end_.notify_one();
  return result;
}

bool WorkerPool::help() {
  std::packaged_task<void()> task;
  {
    const std::lock_guard lock(mutex_);
    if (waiting_.empty()) return false;
    task = std::move(waiting_.front());
    waiting_.pop_front();
  }
  task();
  return true;
}

void WorkerPool::finish(std::future<void> task) {
  while (task.wait_for(std::chrono::seconds(0)) != std::future_status::ready && help()) {
  }
  task.get();
}

void WorkerPool::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    task_or_end_.wait(lock, [this] { return ending_ || !waiting_.empty(); });
    if (ending_) return;
    std::packaged_task<void()> task = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    task();
    task = {};  // what the task owns is freed outside the lock
    lock.lock();
  }
}

}  // namespace esi
