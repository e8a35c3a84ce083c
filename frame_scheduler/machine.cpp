#include "frame_scheduler/machine.h"

#include <sched.h>

#include <fstream>

namespace quadrig::scheduler {

Machine this_machine() {
    Machine machine;
    machine.cpu = "unknown";
    machine.build = QUADRIG_BUILD_TYPE;
    cpu_set_t allowed;
    if (sched_getaffinity(0, sizeof allowed, &allowed) == 0) machine.cores = CPU_COUNT(&allowed);
    std::ifstream stream("/proc/cpuinfo");
    for (std::string line; std::getline(stream, line);) {
        const std::size_t colon = line.find(": ");
        if (!line.starts_with("model name") || colon == std::string::npos) continue;
        machine.cpu = line.substr(colon + 2);
        break;
    }
    return machine;
}

}  // namespace quadrig::scheduler
