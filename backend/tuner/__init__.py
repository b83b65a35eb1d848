"""The weight tuner (Eq. 16): a study is accepted, asked for generations of weights, and compared on fresh roads."""
