#include "live/server.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/serializer.hpp>
#include <boost/beast/http/span_body.hpp>
#include <boost/beast/http/write.hpp>
#include <limits>
#include <optional>
#include <set>
#include <string_view>
#include <thread>
#include <utility>
#include <variant>

#include "live/policy.h"
#include "live/token.h"

namespace popup::live {
namespace {

namespace asio = boost::asio;
namespace http = boost::beast::http;
using asio::ip::tcp;
using boost::system::error_code;
using Clock = std::chrono::steady_clock;
using Text = std::shared_ptr<const std::string>;
using Response = http::response<http::span_body<const char>>;

constexpr std::chrono::milliseconds kFarewell{1000};   // for a client to take the last answer
constexpr std::size_t kDrained = 4096;                 // bytes at a time
constexpr std::chrono::milliseconds kAcceptAgain{50};  // where the system has no more descriptors

std::string_view view_of(boost::beast::string_view text) { return {text.data(), text.size()}; }

// The value of a header that may be there once; what is there twice has no good value.
std::string_view only(const http::fields& fields, std::string_view name) {
    const auto [begin, end] = fields.equal_range(boost::beast::string_view(name.data(), name.size()));
    if (begin == end) return {};
    return std::next(begin) == end ? view_of(begin->value()) : "(several)";
}

// A browser that is opened shall not keep the port.
void keep_from_children(int descriptor) { ::fcntl(descriptor, F_SETFD, FD_CLOEXEC); }

// What is said to one request.
struct Answer {
    int status = 200;
    std::string_view type = "text/plain; charset=utf-8";
    Text body;
    bool head = false;  // its headers only
    bool last = false;  // the connection ends with it
};

}  // namespace

// What the server's thread has in hand.
class Server::Room {
 public:
    explicit Room(Serving serving);
    Room(const Room&) = delete;
    Room& operator=(const Room&) = delete;
    ~Room();
    void put(News news);

    std::string address;

 private:
    class Connection;
    void listen();
    void accept();
    void ended();
    void asked() { last_asked_ = Clock::now(); }
    void watch_idle();

    Serving serving_;
    Door door_;
    Text page_;
    std::string policy_;
    Board board_;
    std::size_t connections_ = 0;
    bool accepting_ = false;
    bool over_ = false;
    std::set<Connection*> waiting_;  // for news
    Clock::time_point last_asked_ = Clock::now();
    // What waits in here holds connections, which tell the members above that they end.
    asio::io_context io_{1};
    tcp::acceptor acceptor_{io_};
    asio::steady_timer again_{io_};
    asio::steady_timer idle_{io_};
    std::thread thread_;
};

// One request after another of one client; it lives as long as something is to happen for it.
class Server::Room::Connection : public std::enable_shared_from_this<Connection> {
 public:
    Connection(Room& room, tcp::socket socket)
        : room_(room), stream_(std::move(socket)), patience_(room.io_) {}
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;
    ~Connection() {
        room_.waiting_.erase(this);
        room_.ended();
    }

    void read();
    void tell_news();
    void tell_end();

 private:
    // A message on its way has to stay where it is.
    struct Sending {
        explicit Sending(Response message) : response(std::move(message)), serializer(response) {}
        Response response;
        http::response_serializer<http::span_body<const char>> serializer;
        Text body;
        bool last = false;
    };
    void decide(const error_code& error);
    void refuse(const Refused& refused, bool head = false);
    void answer(const Asked& asked);
    void wait(const Asked& asked);
    bool stop_waiting();
    [[nodiscard]] Response response_of(const Answer& answer) const;
    void send(Answer answer);
    void drain();

    Room& room_;
    boost::beast::tcp_stream stream_;
    boost::beast::flat_buffer buffer_;
    std::optional<http::request_parser<http::empty_body>> parser_;
    unsigned version_ = 11;
    bool keep_ = false;  // the client does not end the connection
    Asked asked_;        // what it waits for
    asio::steady_timer patience_;
};

void Server::Room::Connection::read() {
    parser_.emplace();
    parser_->header_limit(static_cast<std::uint32_t>(room_.serving_.limits.header));
    // Bodies are judged by the policy, and never read.
    parser_->body_limit(std::numeric_limits<std::uint64_t>::max());
    stream_.expires_after(room_.serving_.limits.request);
    http::async_read_header(
        stream_, buffer_, *parser_,
        [self = shared_from_this()](const error_code& error, std::size_t) { self->decide(error); });
}

void Server::Room::Connection::decide(const error_code& error) {
    keep_ = false;
    if (error == http::error::header_limit) return refuse({431, "This request is too long."});
    if (error) {
        const bool malformed = error.category() == error_code(http::error::bad_target).category() &&
                               error != http::error::end_of_stream && error != http::error::partial_message;
        if (malformed) refuse({400, "This is no request."});
        return;
    }
    const auto& message = parser_->get();
    version_ = message.version();
    keep_ = message.keep_alive();
    const Verdict verdict = judge({.method = view_of(message.method_string()),
                                   .target = view_of(message.target()),
                                   .host = only(message, "Host"),
                                   .origin = only(message, "Origin"),
                                   .fetch_site = only(message, "Sec-Fetch-Site"),
                                   .has_body = !parser_->is_done()},
                                  room_.door_);
    if (const auto* refused = std::get_if<Refused>(&verdict)) {
        return refuse(*refused, message.method() == http::verb::head);
    }
    room_.asked();
    answer(std::get<Asked>(verdict));
}

void Server::Room::Connection::refuse(const Refused& refused, bool head) {
    send({refused.status, "text/plain; charset=utf-8",
          std::make_shared<const std::string>(std::string(refused.why) + "\n"), head, true});
}

void Server::Room::Connection::answer(const Asked& asked) {
    if (asked.what == Wanted::page) return send({200, "text/html; charset=utf-8", room_.page_, asked.head});
    if (const Text news = room_.board_.newer_than(asked.after)) {
        return send({200, "application/json", news, asked.head});
    }
    if (asked.what == Wanted::next && !asked.head) return wait(asked);
    send({204, "application/json", nullptr, asked.head});
}

void Server::Room::Connection::wait(const Asked& asked) {
    asked_ = asked;
    room_.waiting_.insert(this);
    patience_.expires_after(room_.serving_.limits.wait);
    patience_.async_wait([self = shared_from_this()](const error_code& error) {
        if (!error && self->stop_waiting()) self->send({204, "application/json", nullptr});
    });
    // Who has gone, and who talks out of turn, is not waited for. The timer's handler is the other owner.
    stream_.socket().async_wait(tcp::socket::wait_read, [self = shared_from_this()](const error_code& error) {
        if (!error) self->stop_waiting();
    });
}

bool Server::Room::Connection::stop_waiting() {
    if (room_.waiting_.erase(this) == 0) return false;
    room_.asked();
    patience_.cancel();
    error_code ignored;
    stream_.socket().cancel(ignored);
    return true;
}

void Server::Room::Connection::tell_news() {
    const Text news = room_.board_.newer_than(asked_.after);
    if (news && stop_waiting()) send({200, "application/json", news});
}

// In what is free for it in the system's buffer: nothing is on its way to who waits.
void Server::Room::Connection::tell_end() {
    static const auto kOver = std::make_shared<const std::string>(R"({"over":true})");
    Sending sending(response_of({200, "application/json", kOver, false, true}));
    error_code ignored;
    http::write(stream_, sending.serializer, ignored);
}

Response Server::Room::Connection::response_of(const Answer& answer) const {
    Response response(http::int_to_status(static_cast<unsigned>(answer.status)), version_);
    for (const auto& [name, value] : kHeaders) {
        response.set(boost::beast::string_view(name.data(), name.size()),
                     boost::beast::string_view(value.data(), value.size()));
    }
    const bool is_page = answer.body == room_.page_;
    response.set("Content-Security-Policy",
                 is_page ? room_.policy_ : "default-src 'none'; frame-ancestors 'none'");
    if (answer.status == 405) response.set(http::field::allow, "GET, HEAD");
    response.keep_alive(keep_ && !answer.last);
    if (answer.status == 204) return response;
    response.set(http::field::content_type,
                 boost::beast::string_view(answer.type.data(), answer.type.size()));
    response.body() = {answer.body->data(), answer.body->size()};
    response.content_length(answer.body->size());
    return response;
}

void Server::Room::Connection::send(Answer answer) {
    auto sending = std::make_shared<Sending>(response_of(answer));
    sending->body = std::move(answer.body);
    sending->last = !sending->response.keep_alive();
    stream_.expires_after(room_.serving_.limits.answer);
    const auto sent = [self = shared_from_this(), sending](const error_code& error, std::size_t) {
        if (error) return;
        if (!sending->last) return self->read();
        error_code ignored;
        self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
        self->stream_.expires_after(kFarewell);
        self->drain();
    };
    if (answer.head) {
        sending->serializer.split(true);
        http::async_write_header(stream_, sending->serializer, sent);
    } else {
        http::async_write(stream_, sending->serializer, sent);
    }
}

// What is closed with something unread takes back what was answered.
void Server::Room::Connection::drain() {
    buffer_.clear();
    stream_.async_read_some(buffer_.prepare(kDrained),
                            [self = shared_from_this()](const error_code& error, std::size_t) {
                                if (!error) self->drain();
                            });
}

Server::Room::Room(Serving serving) : serving_(std::move(serving)) {
    page_ = std::make_shared<const std::string>(std::move(serving_.page));
    policy_ = serving_.policy + "; frame-ancestors 'none'";
    listen();
    door_ = {new_token(), acceptor_.local_endpoint().port()};
    address = door_.address();
    accept();
    watch_idle();
    thread_ = std::thread([this] { io_.run(); });
}

Server::Room::~Room() {
    asio::post(io_, [this] {
        over_ = true;
        for (Connection* one : waiting_) one->tell_end();
        io_.stop();
    });
    thread_.join();
}

void Server::Room::listen() {
    const tcp::endpoint place(asio::ip::address_v4::loopback(), serving_.port);
    error_code error;
    acceptor_.open(place.protocol(), error);
    if (!error) keep_from_children(acceptor_.native_handle());
    // Who is started again need not wait until the system has forgotten the connections of before.
    if (!error) acceptor_.set_option(tcp::acceptor::reuse_address(true), error);
    if (!error) acceptor_.bind(place, error);
    if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
    if (error) throw CannotServe(error.message(), error == asio::error::address_in_use);
}

void Server::Room::accept() {
    if (over_ || accepting_ || connections_ >= serving_.limits.connections) return;
    accepting_ = true;
    acceptor_.async_accept([this](const error_code& error, tcp::socket socket) {
        accepting_ = false;
        if (error) {
            again_.expires_after(kAcceptAgain);
            again_.async_wait([this](const error_code& stopped) {
                if (!stopped) accept();
            });
            return;
        }
        keep_from_children(socket.native_handle());
        error_code ignored;
        socket.set_option(tcp::no_delay(true), ignored);
        ++connections_;
        std::make_shared<Connection>(*this, std::move(socket))->read();
        accept();
    });
}

void Server::Room::ended() {
    --connections_;
    if (!over_) asio::post(io_, [this] { accept(); });
}

void Server::Room::watch_idle() {
    if (serving_.idle <= std::chrono::milliseconds(0) || !serving_.forsaken) return;
    idle_.expires_at(last_asked_ + serving_.idle);
    idle_.async_wait([this](const error_code& error) {
        if (error) return;
        if (!waiting_.empty()) asked();
        if (Clock::now() < last_asked_ + serving_.idle) return watch_idle();
        serving_.forsaken();
    });
}

void Server::Room::put(News news) {
    asio::post(io_, [this, news = std::move(news)]() mutable {
        board_.put(std::move(news));
        for (Connection* one : std::set<Connection*>(waiting_)) one->tell_news();
    });
}

Server::Server(Serving serving) : room_(std::make_unique<Room>(std::move(serving))) {}
Server::~Server() = default;
const std::string& Server::address() const { return room_->address; }
void Server::put(News news) { room_->put(std::move(news)); }

}  // namespace popup::live
