//! A fern from parameters.
