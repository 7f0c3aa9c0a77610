"""What all pictures share: style, colours, curves with error bars."""
