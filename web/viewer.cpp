// SPDX-License-Identifier: Apache-2.0
#include "web/viewer.h"

#include <fmt/format.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>

#include "base/interruptible.h"
#include "web/access.h"
#include "web/listener.h"
#include "web/page.h"
#include "web/recorded_source.h"
#include "web/server.h"

namespace navcal::web {

void view_recording(const ViewerSettings& settings) {
  boost::asio::io_context context(1);
  // From here on a signal no longer ends the program: what the caller has made for this has to be removed.
  boost::asio::signal_set signals(context);
  for (const int signal : base::ending_signals()) signals.add(signal);
  RecordedLog log(settings.log, settings.progress);
  for (const std::string& remark : log.remarks()) settings.remark(remark);
  const Access access;
  Hub hub;
  Site site;
  const auto source =
      std::make_shared<RecordedSource>(context.get_executor(), hub, std::move(log), settings.name, settings.speed);
  PageFeed::Settings page_settings{.version = settings.version, .player = source.get()};
  const auto page = add_page(site, context.get_executor(), hub, std::move(page_settings));
  const auto server =
      std::make_shared<Server>(listen(context.get_executor(), "127.0.0.1", settings.port), site, access);
  signals.async_wait([&](boost::system::error_code error, int) {
    if (error) return;
    source->stop();
    server->stop();
    context.stop();
  });
  source->start();
  server->start();
  settings.ready(fmt::format("http://127.0.0.1:{}/", server->port()));
  context.run();
}

}  // namespace navcal::web
