"""Messages of other programs and machines as bytes: pure conversions, without sockets."""
