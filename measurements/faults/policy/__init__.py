"""A learned policy on Gymnasium's Pusher-v5, trained here, and what is left of it when a joint fails."""
