/// A counting semaphore (POSIX sem_t). Not std::counting_semaphore: libstdc++ 12.2 can lose its wake-ups (GCC PR
/// 104928).
#pragma once

#include <semaphore.h>

#include <cerrno>

namespace quadrig::display {

class Semaphore {
  public:
    explicit Semaphore(unsigned count) { sem_init(&semaphore_, 0, count); }
    ~Semaphore() { sem_destroy(&semaphore_); }
    Semaphore(const Semaphore&) = delete;
    Semaphore& operator=(const Semaphore&) = delete;

    /// One atomic addition, and a futex wake where somebody waits. Never blocks.
    void post() { sem_post(&semaphore_); }
    /// Takes one if there is one. Never blocks.
    bool try_take() { return sem_trywait(&semaphore_) == 0; }
    void take() {
        while (sem_wait(&semaphore_) != 0 && errno == EINTR) {
        }
    }

  private:
    sem_t semaphore_;
};

}  // namespace quadrig::display
