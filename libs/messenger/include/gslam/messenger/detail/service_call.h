// One call of a service on its way to the one who answers.
#ifndef GSLAM_MESSENGER_DETAIL_SERVICE_CALL_H
#define GSLAM_MESSENGER_DETAIL_SERVICE_CALL_H

#include <gslam/messenger/detail/wait_time.h>
#include <gslam/messenger/errors.h>

#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace gslam {
inline namespace v1 {
namespace detail {

/// Where the answer is put and waited for.
template <class Response>
class ServiceAnswer {
 public:
  void set(Response response) {
    const std::lock_guard<std::mutex> lock(mutex_);
    response_.reset(new Response(std::move(response)));
    finish();
  }
  void fail(const std::exception_ptr& error) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (is_done_) return;
    error_ = error;
    finish();
  }
  /// Whether somebody still waits for it.
  bool isWanted() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return is_wanted_;
  }

  /// @throws ServiceError when there is none in time, and what the handler threw
  template <class Rep, class Period>
  Response waitFor(const std::string& service, const std::chrono::duration<Rep, Period>& time) {
    std::unique_lock<std::mutex> lock(mutex_);
    done_.wait_for(lock, waitTime(time), [this] { return is_done_; });
    is_wanted_ = false;
    if (!is_done_) throw ServiceError(service, ServiceError::timeout);
    if (error_ != nullptr) std::rethrow_exception(error_);
    return std::move(*response_);
  }

 private:
  void finish() {
    is_done_ = true;
    done_.notify_all();
  }

  mutable std::mutex mutex_;
  std::condition_variable done_;
  bool is_done_ = false;
  bool is_wanted_ = true;
  std::unique_ptr<Response> response_;
  std::exception_ptr error_;
};

/// The message that carries a call. Where it ends without an answer, the caller is told.
template <class Request, class Response>
class ServiceCall {
 public:
  ServiceCall(std::string service, Request request)
      : service_(std::move(service)),
        request_(std::move(request)),
        answer_(std::make_shared<ServiceAnswer<Response>>()) {}
  ~ServiceCall() {
    if (answer_ == nullptr) return;
    answer_->fail(std::make_exception_ptr(ServiceError(service_, ServiceError::dropped)));
  }
  ServiceCall(const ServiceCall&) = delete;
  ServiceCall& operator=(const ServiceCall&) = delete;

  const std::shared_ptr<ServiceAnswer<Response>>& answer() const noexcept { return answer_; }

  /// Answers with what the handler returns or throws.
  template <class Handler>
  void answerBy(Handler& handler) const {
    if (!answer_->isWanted()) return;  // who asked has given up
    try {
      answer_->set(handler(request_));
    } catch (...) {
      answer_->fail(std::current_exception());
    }
  }

 private:
  const std::string service_;
  const Request request_;
  const std::shared_ptr<ServiceAnswer<Response>> answer_;
};

/// Takes calls and lets a handler answer them.
template <class Request, class Response, class Handler>
class CallAnswerer {
 public:
  explicit CallAnswerer(Handler handler) : handler_(std::move(handler)) {}
  void operator()(const ServiceCall<Request, Response>& call) { call.answerBy(handler_); }

 private:
  Handler handler_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_DETAIL_SERVICE_CALL_H
