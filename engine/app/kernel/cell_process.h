#pragma once
#include <sys/types.h>

#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "app/kernel/cell_messages.h"
#include "app/live/channel.h"

namespace dynlab::inline app {

/// Runs the cells of a notebook in a separate process, so that a cell that ends its process affects nothing else: a new
/// process is then ready. Only one thread calls ask(); other threads may call interrupt() and stop().
class CellProcess {
  public:
    CellProcess();   ///< to be made before the program has threads
    ~CellProcess();  ///< ends it
    CellProcess(const CellProcess&) = delete;
    CellProcess& operator=(const CellProcess&) = delete;

    using Listener = std::function<void(const CellNews&)>;
    /// Executes an order and passes each message to the listener; the last message is "done". Text that is printed
    /// quickly arrives in larger pieces. If the process ends instead, ask() returns a sentence about the end, and a new
    /// process is already running.
    std::optional<std::string> ask(const CellOrder& order, const Listener& listener);

    /// Stops the cell that runs, and no other: where none does, nothing happens. What is asked for between the order
    /// and the cell's beginning is kept until then.
    void interrupt();
    void stop();  ///< ends the process permanently

  private:
    void start();
    std::optional<CellNews> next();
    std::optional<CellNews> with_what_follows(CellNews printed);
    void note_begun();

    Channel keeper_;                ///< to the process that starts the others; it has no threads
    Channel line_;                  ///< to the one that runs cells
    std::optional<CellNews> held_;  ///< came behind printed text
    std::string ended_;             ///< how the last process did
    std::mutex mutex_;
    pid_t process_ = -1;
    bool running_ = false, begun_ = false, interrupt_waits_ = false, stopped_ = false;
};

}  // namespace dynlab::inline app
