/// SIGINT, SIGTERM and SIGHUP ask a run to end; it does so with its report.
#pragma once

namespace quadrig::appliance {

/// From here on these signals are taken note of, SIGHUP unless it is ignored (nohup). The second one of a kind ends the
/// program at once, as ever.
void watch_stop_signals();
/// Whether one has come.
bool stop_requested();

}  // namespace quadrig::appliance
